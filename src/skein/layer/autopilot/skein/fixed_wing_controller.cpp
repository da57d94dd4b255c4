// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/skein/fixed_wing_controller.h"

#include <algorithm>
#include <utility>

namespace skein::autopilot {
namespace {

constexpr double kFlareHeight = 2.5;  // above ground, of a descent [m]
constexpr double kLowHeight = 15;   // sinks slowly from here: the height is a belief [m]
constexpr double kLowSink = 1.2;    // [m/s]
constexpr double kDescentSink = 2;  // with motor, at most [m/s]
constexpr double kFlareSink = 0.7;  // [m/s]
constexpr double kUnmeasured = 1.12;  // of the demanded airspeed, when none is measured
constexpr double kWheels = 0.15;      // friction at most; a belly has more

FixedWingGuidanceOptions guidance_options(const SkeinSetup& setup) {
  FixedWingGuidanceOptions options = setup.options.wing_guidance;
  const auto& airframe = std::get<FixedWingAirframe>(setup.airframe);
  if (airframe.roll_friction > 0) options.landing.roll_friction = airframe.roll_friction;
  options.landing.brake_friction = airframe.brake_friction;
  if (airframe.roll_friction > kWheels) options.landing.align_height = 0;
  options.landing.lift_off = setup.wing->lift_off;
  return options;
}

}  // namespace

FixedWingController::FixedWingController(const SkeinSetup& setup, const Vec3& home_N)
    : guidance_(guidance_options(setup), setup.limits, home_N),
      control_(setup.wing),
      sink_rate_(std::min(kDescentSink, setup.limits.sink_rate)),
      cruise_(setup.limits.airspeed),
      fastest_(setup.limits.fastest) {}

std::optional<std::string> FixedWingController::command(const AutopilotCommand& command,
                                                        const ControllerView& now) {
  return guidance_.command(command, motion_of(now.nav, now.height_agl));
}

Control FixedWingController::fly(const ControllerView& now, double dt) {
  return control(guidance_.step(motion_of(now.nav, now.height_agl), dt), now, dt);
}

Control FixedWingController::control(const FixedWingDemand& demand,
                                     const ControllerView& now, double dt) {
  phase_ = demand.phase;
  FixedWingDemand safe = demand;
  // By the wind as it is believed: gusts are not felt. Idle flares ask for none.
  if (!now.airspeed && demand.airspeed > 0)
    safe.airspeed = std::min(kUnmeasured * demand.airspeed, fastest_);
  return control_.control(safe, now.nav, dt);
}

Control FixedWingController::release(const ControllerView& now, double dt) {
  phase_ = FlightPhase::kFlight;
  return control_.manual({}, now.nav, dt);
}

bool FixedWingController::coordinated() const {
  switch (phase_) {
    case FlightPhase::kGround:
    case FlightPhase::kRun:
    case FlightPhase::kFlare:
    case FlightPhase::kRollOut:
      return false;
    case FlightPhase::kClimbOut:
    case FlightPhase::kFlight:
    case FlightPhase::kApproach:
    case FlightPhase::kGlide:
      return true;
  }
  return true;
}

void FixedWingController::begin_descent(const ControllerView& now) {
  AutopilotCommand hold;
  hold.guidance = HoldPosition{geo::horizontal(now.nav.p_N)};
  hold.altitude_msl = -now.nav.p_N.z();
  guidance_.command(hold, motion_of(now.nav, now.height_agl));
  descent_altitude_ = -now.nav.p_N.z();
}

Control FixedWingController::descend(const ControllerView& now, double dt) {
  FixedWingDemand demand = guidance_.step(motion_of(now.nav, now.height_agl), dt);
  const bool low = now.height() < kFlareHeight;
  const double sink = low                         ? kFlareSink
                      : now.height() < kLowHeight ? std::min(kLowSink, sink_rate_)
                                                  : sink_rate_;
  // Not further ahead of the aircraft than it can follow.
  const double altitude = -now.nav.p_N.z();
  descent_altitude_ = std::max(descent_altitude_ - sink * dt, altitude - 5);
  demand.altitude_msl = descent_altitude_;
  demand.climb_rate = -sink;
  demand.airspeed = cruise_;
  if (!now.motor) demand.phase = FlightPhase::kGlide;
  if (low) {
    demand.lateral_acceleration = 0;
    demand.phase = FlightPhase::kFlare;
    demand.airspeed = 0;  // motor idle
  }
  return control(demand, now, dt);
}

Control FixedWingController::pilot(const PilotInput& sticks, const ControllerView& now,
                                   double dt) {
  phase_ = FlightPhase::kFlight;
  if (sticks.mode == FlightMode::kManual) return control_.manual(sticks, now.nav, dt);
  return control_.stabilize(control_.attitude_for(sticks), now.nav, dt);
}

Control FixedWingController::stand(const ControllerView& now, double dt) {
  FixedWingDemand still;
  still.phase = FlightPhase::kGround;
  return control(still, now, dt);
}

void FixedWingController::change(const LateralOptions& lateral,
                                 std::shared_ptr<const FixedWingSetup> wing) {
  guidance_.change(lateral);
  control_.change(std::move(wing));
}

void FixedWingController::take_over(const ControllerView& now) {
  guidance_.forget(motion_of(now.nav, now.height_agl));
  control_.reset(now.nav);
}

}  // namespace skein::autopilot
