// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/skein/multirotor_controller.h"

#include <algorithm>
#include <cmath>

namespace skein::autopilot {
namespace {

// Without a position the velocity is known less from second to second: down quickly, and
// gently only above the ground, which the barometer knows within some metres.
constexpr double kBlindSink = 1;    // below kBlindHeight, at most [m/s]
constexpr double kBlindHeight = 8;  // [m]
// Close to the ground, a vehicle that does not sink although it shall stands on it.
constexpr double kStillSink = 0.15;  // [m/s]
constexpr double kPushed = 2;        // the demanded altitude below its own [m]
constexpr double kStandsAfter = 1;   // [s]

}  // namespace

MultirotorController::MultirotorController(const SkeinSetup& setup, const Vec3& home_N)
    : guidance_(setup.options.rotor_guidance,
                std::get<MultirotorAirframe>(setup.airframe), home_N),
      control_(setup.rotors),
      sink_rate_(setup.limits.sink_rate) {}

std::optional<std::string> MultirotorController::command(const AutopilotCommand& command,
                                                         const ControllerView& now) {
  return guidance_.command(command, now.nav);
}

Control MultirotorController::fly(const ControllerView& now, double dt) {
  const MultirotorDemand demand = guidance_.step(now.nav, dt, now.height_agl);
  if (demand.phase == FlightPhase::kGround) return stand(now, dt);
  return control_.control(demand, now.nav, dt);
}

void MultirotorController::begin_descent(const ControllerView& now) {
  AutopilotCommand land;
  land.guidance = Land{geo::horizontal(now.nav.p_N), now.ground_msl};
  land.altitude_msl = -now.nav.p_N.z();
  guidance_.command(land, now.nav);
  descent_altitude_ = -now.nav.p_N.z();
  heading_ = geo::yaw(now.nav.q_NB);
  still_for_ = 0;
}

Control MultirotorController::descend(const ControllerView& now, double dt) {
  if (now.position) return fly(now, dt);
  MultirotorDemand demand;
  demand.holds_position = false;
  const double altitude = -now.nav.p_N.z();
  const double sink =
      now.height() < kBlindHeight ? std::min(kBlindSink, sink_rate_) : sink_rate_;
  descent_altitude_ = std::max(descent_altitude_ - sink * dt, altitude - 3);
  demand.altitude_msl = descent_altitude_;
  demand.climb_rate = -sink;
  const bool stands = now.height() < kBlindHeight &&
                      altitude - descent_altitude_ > kPushed &&
                      std::abs(now.nav.v_N.z()) < kStillSink;
  still_for_ = stands ? still_for_ + dt : 0;
  if (still_for_ > kStandsAfter) return stand(now, dt);
  demand.heading = heading_;
  return control_.control(demand, now.nav, dt);
}

Control MultirotorController::pilot(const PilotInput& sticks, const ControllerView& now,
                                    double dt) {
  if (sticks.mode == FlightMode::kManual) return control_.manual(sticks, now.nav, dt);
  return control_.stabilize(control_.attitude_for(sticks), now.nav, dt);
}

Control MultirotorController::stand(const ControllerView&, double) {
  return Actuators{};
}

void MultirotorController::take_over(const ControllerView& now) {
  guidance_.forget(now.nav);
  control_.reset(now.nav);
}

}  // namespace skein::autopilot
