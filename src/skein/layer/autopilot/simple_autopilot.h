// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "skein/layer/autopilot/guidance.h"
#include "skein/layer/autopilot/guidance/fixed_wing_guidance.h"
#include "skein/layer/autopilot/nav_filter.h"
#include "skein/model/path/path_cursor.h"
#include "skein/role/autopilot.h"

namespace skein::autopilot {

struct SimpleAutopilotOptions {
  GuidanceOptions guidance;
  double altitude_gain = 0.3;  ///< climb rate per altitude error [1/s]
  double wind_lag = 15;        ///< time constant of the reported wind [s]
  double slowest = 0.8;  ///< minimum airspeed, in cruise, for turns that are too tight
};

/// Flies paths, courses and circles over ground in wind, and holds altitude.
///
/// Lateral: a course demand (guidance.h) becomes a turn rate and, by tan(roll) =
/// omega V / g, a roll within the vehicle's smallest turn. Vertical: climb rate in
/// proportion to the altitude error. Airspeed: cruise, less where a turn over ground is
/// too tight for it in the wind:
///
///   V + |wind| <= sqrt(g tan(roll limit) / curvature)
///
/// A repeated path goes on where it is, so that only its altitude changes.
/// Until the first command it circles the place where it was made.
///
/// Plans, waypoints, banks, take-off, landing and return are flown by FixedWingGuidance
/// with the same gains; its lateral acceleration a becomes tan(roll) = a / (g cos(drift
/// angle)). Of these, what cannot be flown is refused (AutopilotStatus::refused) and the
/// old command goes on. The vehicle starts in the air and has no wheels: take-off climbs,
/// and a landing ends 30 m above the ground, in a circle around the point. Valid: turns
/// too tight even then are flown as tightly as the vehicle can and joined again; see
/// docs/aircraft.md.
class SimpleAutopilot final : public Autopilot {
 public:
  /// @param limits   of the vehicle.
  /// @param initial  where and how it flies at the start.
  SimpleAutopilot(const SimpleAutopilotOptions& options, const FlightLimits& limits,
                  const NavEstimate& initial);

  /// Home stays where it is, and the last command is flown again from its beginning.
  void begin(const NavEstimate& start, bool on_ground) override;
  void sense(const SensorSample& sample) override;
  void command(const AutopilotCommand& command) override;
  /// It has no failsafes: the last place of the route is where a commanded return leads,
  /// straight.
  void set_return(const ReturnRoute& route) override;
  /// A FlightCommand.
  Control control(Time now, double dt) override;
  NavEstimate estimate() const override { return filter_.estimate(); }
  AutopilotStatus status() const override { return status_; }

 private:
  SimpleAutopilot(const SimpleAutopilotOptions& options, const FlightLimits& limits,
                  const NavEstimate& initial, const Vec3& home_N);

  CourseDemand demand(const Motion& motion);
  CourseDemand follow(const Motion& motion, double ground_speed);
  FlightCommand fly_shared(double dt);
  void refuse(std::string reason);
  void begin_status(AutopilotStatus status);
  double climb_rate(double altitude_msl, double rate) const;
  FixedWingMotion motion(const Vec2& wind) const;
  Circle circle_around(const Vec2& centre) const;
  double airspeed_for_turns() const;

  SimpleAutopilotOptions options_;
  FlightLimits limits_;
  double roll_limit_;
  NavFilter filter_;
  AutopilotCommand command_;
  AutopilotStatus status_;
  model::PathCursor path_;
  double along_ = 0;   // of the path, where the vehicle is
  Circle end_circle_;  // flown when the path is done
  Circle hold_circle_;
  Vec3 home_N_;
  std::optional<Vec2> return_;  // none: home
  FixedWingGuidance shared_;    // flies what is not flown here
  bool is_shared_ = false;
  std::string refused_;
};

}  // namespace skein::autopilot
