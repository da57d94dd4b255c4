// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/control/multirotor_gains.h"

#include <algorithm>

#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"

namespace skein::autopilot {
namespace {

constexpr double kAssumedLag = 0.05;  // of a small motor [s]
// Loop gain over 1/lag: damping 1/(2 sqrt(0.5)) = 0.7 of rate loop and motor.
constexpr double kRateShare = 0.5;
constexpr double kMinScale = 0.4, kMaxScale = 2.5;
constexpr double kTiltShare = 0.4;  // of the rate gain

MultirotorGains completed(MultirotorGains g, double lag) {
  if (!(g.rate_gain > 0)) g.rate_gain = std::min(kRateShare / lag, 25.0);
  if (!(g.tilt_gain > 0)) g.tilt_gain = kTiltShare * g.rate_gain;
  return g;
}

}  // namespace

MultirotorSetup::MultirotorSetup(const MultirotorAirframe& a, const MultirotorGains& g)
    : airframe(a),
      motor_lag(a.motor_lag > 0 ? a.motor_lag : kAssumedLag),
      gains(completed(g, motor_lag)),
      min_scale(
          std::max(kMinScale, kGravity / (kGravity + 0.9 * gains.acceleration_limit))),
      max_scale(
          std::min(kMaxScale,
                   kGravity / std::max(kGravity - 0.9 * gains.acceleration_limit, 1e-3))),
      tilt_tangent(math::tan(a.tilt_limit > 0 ? a.tilt_limit : 0.6)),
      max_thrust(a.thrust_max * static_cast<double>(a.rotors.size())) {}

}  // namespace skein::autopilot
