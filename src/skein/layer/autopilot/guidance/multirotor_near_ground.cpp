// SPDX-License-Identifier: Apache-2.0
// MultirotorGuidance in the take-off and the landing.

#include <algorithm>
#include <cmath>

#include "skein/layer/autopilot/guidance/multirotor_guidance.h"
#include "skein/layer/autopilot/guidance/multirotor_reference.h"

namespace skein::autopilot {
namespace {

constexpr double kStillSink = 0.15;  // slower than this does not sink [m/s]
constexpr double kStillTime = 1;     // for this long: on the ground [s]
constexpr double kPushed = 0.3;      // the reference this deep in the ground [m]
constexpr double kDeepest = 1;       // and no deeper [m]

}  // namespace

MultirotorGuidance::Setpoint MultirotorGuidance::take_off(const NavState& now) {
  status_.remaining = std::max(altitude_ + now.p_N.z(), 0.0);
  status_.done = status_.done || status_.remaining <= options_.arrival;
  phase_ = status_.done ? FlightPhase::kFlight : FlightPhase::kClimbOut;
  return towards(point_, now);
}

MultirotorGuidance::Setpoint MultirotorGuidance::land(const NavState& now, double dt,
                                                      std::optional<double> height_agl) {
  const Land& land = std::get<Land>(command_.guidance);
  const double height = height_agl.value_or(-now.p_N.z() - land.ground_msl);
  Setpoint setpoint = towards(point_, now);
  status_.remaining = (point_ - now.p_N.head<2>()).norm();
  if (phase_ == FlightPhase::kFlight && status_.remaining <= options_.arrival &&
      velocity_.norm() < kCreep)
    phase_ = FlightPhase::kApproach;
  if (phase_ == FlightPhase::kFlight) return setpoint;
  if (phase_ == FlightPhase::kApproach && height <= options_.slow_height)
    phase_ = FlightPhase::kFlare;

  // The reference sinks by its rate: braked before slow_height, then slowly until the
  // ground holds the vehicle up.
  const double b = options_.braking * options_.climb_acceleration;
  const double above = std::max(height - options_.slow_height, 0.0);
  const double sink =
      std::min(options_.touch_down_sink + std::sqrt(2 * b * above), limits_.sink_rate);
  setpoint.altitude = altitude_ref_;
  setpoint.climb_rate = -sink;
  const bool pushed = altitude_ref_ < -now.p_N.z() - kPushed;
  still_for_ = pushed && std::abs(now.v_N.z()) < kStillSink ? still_for_ + dt : 0;
  if (altitude_ref_ < -now.p_N.z() - kDeepest) setpoint.climb_rate = 0;
  if (still_for_ >= kStillTime) phase_ = FlightPhase::kGround;
  if (phase_ == FlightPhase::kGround) {
    status_.done = true;
    setpoint.velocity.setZero();
    setpoint.climb_rate = 0;
  }
  return setpoint;
}

}  // namespace skein::autopilot
