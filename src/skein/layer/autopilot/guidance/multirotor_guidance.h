// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "skein/data/vehicle/airframe.h"
#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/layer/autopilot/demand.h"
#include "skein/layer/autopilot/guidance/waypoint_route.h"
#include "skein/layer/autopilot/nav_state.h"
#include "skein/model/path/path_cursor.h"
#include "skein/model/path/plan_curve.h"

namespace skein::autopilot {

struct MultirotorGuidanceOptions {
  double acceleration = 3;        ///< of the reference, horizontal [m/s^2]
  double jerk = 15;               ///< its largest change [m/s^3]
  double braking = 0.7;           ///< share of `acceleration` that stops are planned with
  double stop_gain = 1.5;         ///< speed per distance left, close to a stop [1/s]
  double climb_acceleration = 2;  ///< [m/s^2]
  double corner_cut = 0;          ///< how far inside waypoints may be passed [m]; 0: stop
  double max_lag = 5;             ///< the reference waits for the vehicle beyond this [m]
  bool yaws_along_track = true;   ///< false: keeps the heading it has
  double yaw_rate = 1;            ///< [rad/s]
  double arrival = 1;             ///< from a point or altitude, counted as there [m]
  double slow_height = 8;         ///< of the last part of a landing [m]
  double touch_down_sink = 0.5;   ///< there [m/s]
  double return_height = 30;      ///< minimum, above where the flight began [m]
};

/// Flies commands with a multirotor: a reference that moves in space and that a control
/// loop can follow without overshoot.
///
/// The reference (position, velocity, acceleration) takes up a velocity setpoint v_d with
/// a = a_f + 4/s (v_d - v), bounded in size (`acceleration`) and change (`jerk`); a_f is
/// the centripetal acceleration of a turn and the braking before a stop. Speed setpoints
/// are those of the command, at most
///
///   sqrt(0.7 acceleration / curvature)      in turns,
///   min(k d, sqrt(2 b (d - b / 2 k^2)))     at distance d from a stop; b = braking
///                                           acceleration, k = stop_gain, the first for d
///                                           < b / k^2,
///
/// before turns what braking needs, and on climbing legs what the climb rate allows. The
/// commanded airspeed holds in the air: V_g = wind along + sqrt(V^2 - wind across^2), up
/// to `fastest` where it would leave less than 1 m/s over ground. The reference brakes
/// to a stand when it is 2 `max_lag` ahead of the vehicle.
///
/// - FollowPath: along it, stop at its end. FlyWaypoints: straight legs, stop at each
///   corner unless `corner_cut`. Circle: onto it and around.
/// - FollowPlan: where the plan is now; before its first time at its start.
/// - HoldCourse: that course over ground; position does not count.
/// - TakeOff: straight up. Land: above the point, straight down, slow below slow_height.
/// - Return: up to return_height at least, to the point or home, stay.
///
/// Until the first command it stays where it is at the first step.
class MultirotorGuidance {
 public:
  /// @param home_N  where the flight began.
  MultirotorGuidance(const MultirotorGuidanceOptions& options,
                     const MultirotorAirframe& airframe, const Vec3& home_N);

  /// As FixedWingGuidance::command.
  std::optional<std::string> command(const AutopilotCommand& command,
                                     const NavState& now);

  /// Somebody else has flown: the reference begins anew from this motion, and stops as
  /// soon as it can.
  void forget(const NavState& now);

  /// The demand for the next `dt` [s]. Always finite if the motion is.
  /// @param height_agl  measured [m], if it is.
  MultirotorDemand step(const NavState& now, double dt,
                        std::optional<double> height_agl = std::nullopt);

  const AutopilotStatus& status() const { return status_; }
  const AutopilotCommand& current() const { return command_; }

 private:
  // What the reference shall do now.
  struct Setpoint {
    Vec2 velocity = Vec2::Zero();
    Vec2 acceleration = Vec2::Zero();  // fed forward
    double altitude = 0, climb_rate = 0;
  };
  // The speed at a distance before a stop, and the braking that keeps to it.
  struct Stop {
    double speed, braking;
  };
  void begin(const AutopilotCommand& command, const NavState& now);
  void reset(const NavState& now);
  void arrive(const Vec2& at);
  Setpoint hold(const NavState& now);
  Setpoint hold_course(const NavState& now);
  Setpoint follow_path(const NavState& now);
  Setpoint follow_plan(const NavState& now);
  Setpoint fly_waypoints(const NavState& now);
  Setpoint circle(const NavState& now);
  Setpoint take_off(const NavState& now);
  Setpoint land(const NavState& now, double dt, std::optional<double> height_agl);
  Setpoint along(const model::PathCursor& path, const model::PathCursor::Place& place,
                 const Stop& stop, const NavState& now);
  Setpoint towards(const Vec2& point, const NavState& now) const;
  double ground_speed(const Vec2& course, const NavState& now) const;
  Stop stop_at(double distance) const;
  void move(const Setpoint& setpoint, const NavState& now, double dt);
  void turn(double dt);

  MultirotorGuidanceOptions options_;
  FlightLimits limits_;
  Vec3 home_N_;

  AutopilotCommand command_;
  AutopilotStatus status_;
  enum class Doing : std::uint8_t {
    kHold,
    kCourse,
    kPath,
    kPlan,
    kWaypoints,
    kCircle,
    kTakeOff,
    kLand
  };
  Doing doing_ = Doing::kHold;
  bool started_ = false;
  Vec2 position_ = Vec2::Zero(), velocity_ = Vec2::Zero(), acceleration_ = Vec2::Zero();
  double altitude_ref_ = 0, climb_ref_ = 0;
  double heading_ = 0;
  double altitude_ = 0;  // to go to
  Vec2 point_ = Vec2::Zero();
  bool climbs_first_ = false;
  Circle circle_;
  Vec2 course_ = Vec2(1, 0);
  model::PathCursor path_;
  double along_ = 0;
  model::PlanCurve plan_;
  WaypointRoute route_;
  FlightPhase phase_ = FlightPhase::kFlight;
  double still_for_ = 0;
};

}  // namespace skein::autopilot
