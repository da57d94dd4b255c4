// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/layer/autopilot/demand.h"
#include "skein/layer/autopilot/guidance/landing.h"
#include "skein/layer/autopilot/guidance/lateral.h"
#include "skein/layer/autopilot/guidance/waypoint_route.h"
#include "skein/layer/autopilot/nav_state.h"
#include "skein/model/path/path_cursor.h"
#include "skein/model/path/plan_curve.h"

namespace skein::autopilot {

struct FixedWingGuidanceOptions {
  LateralOptions lateral;
  LandingOptions landing;
  bool rounds_corners = true;    ///< of waypoints; false: flown over, then turned
  double radius_margin = 1.1;    ///< corners and loiter circles, over the minimum radius
  double slow_down = 6;          ///< flight before a tight turn in which to slow down [s]
  double time_gain = 0.1;        ///< share of ground speed per second behind a plan [1/s]
  double time_reach = 0.3;       ///< largest such share
  double speed_lead = 1.5;       ///< airspeeds of a plan are demanded this early [s]
  double take_off_speed = 1.1;   ///< leaving the ground, over the slowest airspeed
  double climb_out_height = 40;  ///< straight climb after take-off [m]
  double arrival = 5;            ///< of an altitude, counted as reached [m]
  double return_height = 60;     ///< minimum, above where the flight began [m]
  /// Commands that cannot be flown are refused; false: flown as near as it can.
  bool refuses = true;
};

/// The own motion as guidance needs it: what of a NavState counts, or of a simpler
/// estimate.
struct FixedWingMotion {
  Time time;
  Vec3 p_N = Vec3::Zero();          ///< [m]
  Vec3 v_N = Vec3::Zero();          ///< over ground [m/s]
  Vec2 wind = Vec2::Zero();         ///< [m/s]
  double airspeed = 0;              ///< [m/s]
  double lateral_acceleration = 0;  ///< across the ground track now [m/s^2]
  std::optional<double> height_agl = std::nullopt;  ///< measured, near the ground [m]
};

/// Lateral acceleration from the bank (a coordinated turn): g tan(roll) cos(drift angle).
FixedWingMotion motion_of(const NavState& nav,
                          std::optional<double> height_agl = std::nullopt);

/// Flies commands with a fixed wing: what turn, altitude and airspeed to demand now.
///
/// - FollowPath: near the last point only, so that a path may cross itself; slower where
///   a turn over ground is too tight at the airspeed: V + |wind| <= sqrt(0.9 a_max /
///   curvature). After the end a circle around it.
/// - FollowPlan: nearest point of the curve, altitude from there; ground speed = the
///   curve's times 1 + clamp(time_gain e_t, +-time_reach) with e_t = now - time of the
///   nearest point; airspeed from the wind triangle, within its limits; or the commanded
///   airspeed, without regard to the times.
/// - FlyWaypoints: straight legs, corners rounded at the radius the wind allows.
/// - Circle, HoldPosition: not tighter than the wind allows at the slowest airspeed
///   (hold: at cruise).
/// - HoldBank: that bank, as far as its limit allows.
/// - TakeOff: run along the start's course until take_off_speed, straight climb to
///   climb_out_height, then circling up to the altitude.
/// - Land: see Landing.
/// - Return: to the point or home, at the commanded altitude but return_height above the
///   start at least.
///
/// Until the first command it circles home.
class FixedWingGuidance {
 public:
  /// @param home  where the flight began.
  FixedWingGuidance(const FixedWingGuidanceOptions& options, const FlightLimits& limits,
                    const Vec3& home_N);

  /// Takes a new command, unless it cannot be flown: then the reason is returned and
  /// everything goes on as it was. The same path or plan again goes on where it is.
  std::optional<std::string> command(const AutopilotCommand& command,
                                     const FixedWingMotion& now);

  /// The demand for the next `dt` [s]. Always finite if the motion is.
  FixedWingDemand step(const FixedWingMotion& now, double dt);

  /// Circles where it is; the next command is a new one in any case.
  void forget(const FixedWingMotion& now);

  /// Another lateral guidance from the next step on; what is flown goes on.
  void change(const LateralOptions& lateral);

  /// Fields of guidance only.
  const AutopilotStatus& status() const { return status_; }
  const AutopilotCommand& current() const { return command_; }
  /// Where it would circle a point now: minimum radius at cruise in this wind, with
  /// margin.
  double loiter_radius(double wind_speed) const;

 private:
  void begin(const AutopilotCommand& command, const FixedWingMotion& now);
  void hold_at(const Vec2& centre, const FixedWingMotion& now);
  void arrive(const Vec2& at, const FixedWingMotion& now);
  double banked(const FixedWingMotion& now) const;
  double circle(const FixedWingMotion& now, FixedWingDemand& demand);
  double follow_path(const FixedWingMotion& now, FixedWingDemand& demand);
  double follow_plan(const FixedWingMotion& now, double dt, FixedWingDemand& demand);
  double fly_waypoints(const FixedWingMotion& now, FixedWingDemand& demand);
  double take_off(const FixedWingMotion& now, FixedWingDemand& demand);
  double climb_airspeed() const;
  double land(const FixedWingMotion& now, double dt, FixedWingDemand& demand);
  double hold_course(const Vec2& course, const FixedWingMotion& now) const;
  double airspeed_for(double curvature, double wind_speed) const;
  double base_airspeed() const;
  FlightLimits judged_by() const;
  double steer(const model::PathCursor& path, const model::PathCursor::Place& place,
               const FixedWingMotion& now) const;

  FixedWingGuidanceOptions options_;
  FlightLimits limits_;
  Vec3 home_N_;
  Sight sight_;
  double max_lateral_;   // acceleration at the bank limit [m/s^2]
  double turn_slowest_;  // minimum airspeed in a turn at the bank limit [m/s]

  AutopilotCommand command_;
  AutopilotStatus status_;
  enum class Doing : std::uint8_t {
    kCourse,
    kBank,    // bank_
    kCircle,  // hold_
    kPath,
    kPlan,
    kWaypoints,
    kTakeOff,
    kLand
  };
  Doing doing_ = Doing::kCircle;
  Circle hold_;
  double min_hold_ = 0;  // radius asked for [m]; 0 = as tight as the wind allows
  double altitude_ = 0;  // demanded when the guidance has none of its own [m]
  Vec2 course_ = Vec2(1, 0);
  double bank_ = 0;  // [rad]
  model::PathCursor path_;
  double along_ = 0;
  model::PlanCurve plan_;
  double plan_time_ = 0;  // of the nearest point [s]
  WaypointRoute route_;
  Landing landing_;
  FlightPhase phase_ = FlightPhase::kFlight;
  Vec2 run_start_ = Vec2::Zero();
  double run_altitude_ = 0;
};

}  // namespace skein::autopilot
