// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/control/fixed_wing_gains.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"

namespace skein::autopilot {
namespace {

constexpr double kFilterCruise = 15;   // for which gust_filter is given [m/s]
constexpr double kMinRestLoad = 0.25;  // wings carry something, standing, at cruise

void assume(double& value, double otherwise) {
  if (!(value > 0)) value = otherwise;
}

// Values of a small aircraft in place of what is not known: the integrators make up for
// the difference.
FixedWingAirframe completed(FixedWingAirframe a) {
  assume(a.cruise, 15);
  assume(a.slowest, 0.7 * a.cruise);
  assume(a.fastest, 1.4 * a.cruise);
  assume(a.bank_limit, 0.6);
  assume(a.pitch_up, 0.35);
  if (!(a.pitch_down < 0)) a.pitch_down = -0.35;
  assume(a.climb_rate, 0.12 * a.cruise);
  assume(a.sink_rate, 0.1 * a.cruise);
  assume(a.aileron_power, 60);
  assume(a.roll_damping, 12);
  assume(a.elevator_power, 25);
  assume(a.pitch_damping, 5);
  assume(a.pitch_stiffness, 60);
  assume(a.lift_slope, 4);
  assume(a.rudder_power, 5);
  return a;
}

}  // namespace

FixedWingSetup::FixedWingSetup(const FixedWingAirframe& a, const FixedWingGains& g)
    : gains(g),
      airframe(completed(a)),
      gust_bandwidth(g.gust_filter * kFilterCruise / airframe.cruise),
      bank_tangent(math::tan(airframe.bank_limit)),
      lift_off(0),
      alpha_per_load(kGravity / (airframe.cruise * airframe.lift_slope)),
      throttle_slope((1 - std::min(airframe.trim_throttle, 0.9)) / airframe.climb_rate) {
  // Lift grows evenly with the pitch, and with the square of the airspeed.
  const double load = 1 + (airframe.rest_pitch - airframe.trim_alpha) / alpha_per_load;
  lift_off = airframe.cruise / std::sqrt(std::max(load, kMinRestLoad));
}

}  // namespace skein::autopilot
