// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/skein/point_controller.h"

#include <algorithm>

#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"

namespace skein::autopilot {
namespace {

// Without wheels a landing ends in the air; see LandingOptions.
FixedWingGuidanceOptions in_the_air(FixedWingGuidanceOptions options) {
  options.landing.touches_down = false;
  return options;
}

}  // namespace

PointController::PointController(const SkeinSetup& setup, const Vec3& home_N)
    : guidance_(in_the_air(setup.options.wing_guidance), setup.limits, home_N),
      limits_(setup.limits),
      roll_limit_(math::atan(limits_.airspeed * limits_.airspeed /
                             (kGravity * limits_.turn_radius))),
      altitude_gain_(setup.options.point_gains.altitude_gain) {}

std::optional<std::string> PointController::command(const AutopilotCommand& command,
                                                    const ControllerView& now) {
  return guidance_.command(command, motion_of(now.nav, now.height_agl));
}

Control PointController::for_plant(const FixedWingDemand& demand,
                                   const NavState& nav) const {
  const Vec2 course = geo::horizontal(nav.v_N);
  const double speed = course.norm();
  // Cosine between the ground track and the heading; never much drift at flying speed.
  const double along =
      speed > 0.1 ? std::max(0.3, course.dot(geo::unit(geo::yaw(nav.q_NB))) / speed)
                  : 1.0;
  FlightCommand command;
  command.roll = std::clamp(math::atan(demand.lateral_acceleration / (kGravity * along)),
                            -roll_limit_, roll_limit_);
  command.airspeed = demand.airspeed;
  command.climb_rate =
      std::clamp(demand.climb_rate + altitude_gain_ * (demand.altitude_msl + nav.p_N.z()),
                 -limits_.sink_rate, limits_.climb_rate);
  return command;
}

Control PointController::fly(const ControllerView& now, double dt) {
  return for_plant(guidance_.step(motion_of(now.nav, now.height_agl), dt), now.nav);
}

void PointController::begin_descent(const ControllerView& now) {
  AutopilotCommand hold;
  hold.guidance = HoldPosition{geo::horizontal(now.nav.p_N)};
  hold.altitude_msl = -now.nav.p_N.z();
  guidance_.command(hold, motion_of(now.nav, now.height_agl));
}

Control PointController::descend(const ControllerView& now, double dt) {
  FixedWingDemand demand = guidance_.step(motion_of(now.nav, now.height_agl), dt);
  demand.altitude_msl = -now.nav.p_N.z();
  demand.climb_rate = -limits_.sink_rate / 2;
  return for_plant(demand, now.nav);
}

Control PointController::pilot(const PilotInput& sticks, const ControllerView&, double) {
  FlightCommand command;
  command.roll = std::clamp(sticks.roll, -1.0, 1.0) * roll_limit_;
  command.climb_rate = std::clamp(sticks.pitch, -1.0, 1.0) *
                       (sticks.pitch > 0 ? limits_.climb_rate : limits_.sink_rate);
  command.airspeed = limits_.slowest + std::clamp(sticks.throttle, 0.0, 1.0) *
                                           (limits_.fastest - limits_.slowest);
  return command;
}

Control PointController::stand(const ControllerView&, double) {
  return FlightCommand{0, limits_.slowest, 0};
}

void PointController::take_over(const ControllerView& now) {
  guidance_.forget(motion_of(now.nav, now.height_agl));
}

}  // namespace skein::autopilot
