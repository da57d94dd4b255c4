#include "layer/autopilot/skein/rotor_flier.h"

#include <algorithm>

namespace skein::autopilot {
namespace {

constexpr double kBlindSink = 1;  // without a position, at most [m/s]

}  // namespace

RotorFlier::RotorFlier(const SkeinSetup& setup, const Vec3& home_N)
    : guidance_(setup.options.rotor_guidance,
                std::get<MultirotorAirframe>(setup.airframe), home_N),
      control_(setup.rotors),
      sink_rate_(std::min(kBlindSink, setup.limits.sink_rate)) {}

std::optional<std::string> RotorFlier::command(const AutopilotCommand& command,
                                               const FlierView& now) {
  return guidance_.command(command, now.nav);
}

Control RotorFlier::fly(const FlierView& now, double dt) {
  const MultirotorDemand demand = guidance_.step(now.nav, dt, now.height_agl);
  if (demand.phase == FlightPhase::kGround) return stand();
  return control_.control(demand, now.nav, dt);
}

void RotorFlier::begin_descent(const FlierView& now) {
  AutopilotCommand land;
  land.guidance = Land{geo::horizontal(now.nav.p_N), now.ground_msl};
  land.altitude_msl = -now.nav.p_N.z();
  guidance_.command(land, now.nav);
  descent_altitude_ = -now.nav.p_N.z();
  heading_ = geo::yaw(now.nav.q_NB);
}

Control RotorFlier::descend(const FlierView& now, double dt) {
  if (now.position) return fly(now, dt);
  MultirotorDemand demand;
  demand.holds_position = false;
  const double altitude = -now.nav.p_N.z();
  descent_altitude_ = std::max(descent_altitude_ - sink_rate_ * dt, altitude - 3);
  demand.altitude_msl = descent_altitude_;
  demand.climb_rate = -sink_rate_;
  demand.heading = heading_;
  return control_.control(demand, now.nav, dt);
}

Control RotorFlier::pilot(const PilotInput& sticks, const FlierView& now, double dt) {
  if (sticks.mode == FlightMode::kManual) return control_.manual(sticks, now.nav, dt);
  return control_.stabilize(control_.attitude_for(sticks), now.nav, dt);
}

Control RotorFlier::stand() {
  return Actuators{};
}

void RotorFlier::take_over(const FlierView& now) {
  guidance_.forget(now.nav);
  control_.reset(now.nav);
}

}  // namespace skein::autopilot
