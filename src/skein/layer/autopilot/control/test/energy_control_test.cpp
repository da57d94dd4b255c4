// SPDX-License-Identifier: Apache-2.0
// The energy law flies a point mass whose engine is not what its airframe says.
#include "skein/layer/autopilot/control/energy_control.h"

#include <gtest/gtest.h>

#include "skein/data/vehicle/air.h"

namespace skein::autopilot::energy_control_test {
namespace {

constexpr double kStep = 0.02;

FixedWingAirframe airframe() {
  FixedWingAirframe a;
  a.mass = 1000;
  a.slowest = 34;
  a.cruise = 50;
  a.fastest = 62;
  a.pitch_up = 0.26;
  a.pitch_down = -0.21;
  a.climb_rate = 4;
  a.sink_rate = 3;
  a.trim_alpha = 0.03;
  a.trim_throttle = 0.6;
  return a;
}

// Flies level for five minutes from an airspeed; throttle makes so much of the power that
// the airframe says.
EnergyView flown(double airspeed, double engine) {
  const FixedWingSetup setup(airframe(), {});
  EnergyControl control;
  EnergyView view;
  view.airspeed = view.calm_airspeed = airspeed;
  view.altitude_msl = 900;
  FixedWingDemand demand;
  demand.altitude_msl = 900;
  demand.airspeed = 50;
  control.reset(view, 0.05, 0);
  for (int k = 0; k < 15000; ++k) {
    const EnergyOutput out = control.step(setup, demand, view, kStep);
    const double v = view.airspeed;
    // Level flight at any airspeed takes what it takes at cruise.
    const double energy = (engine * out.throttle - 0.6) / setup.throttle_slope;
    const double alpha = 0.03 + setup.alpha_per_load * (2500 / (v * v) - 1);
    view.climb_rate = v * (out.pitch - alpha);
    view.altitude_msl += view.climb_rate * kStep;
    view.airspeed += kGravity / v * (energy - view.climb_rate) * kStep;
    view.calm_airspeed = view.airspeed;
  }
  return view;
}

TEST(EnergyControl, ComesToSpeedAndHeightWithAWeakEngineFromAnyAirspeed) {
  for (const double engine : {1.0, 0.85, 0.75})
    for (const double airspeed : {30.0, 33.0, 36.0, 50.0, 60.0}) {
      const EnergyView end = flown(airspeed, engine);
      EXPECT_NEAR(end.airspeed, 50, 0.5) << engine << " from " << airspeed;
      EXPECT_NEAR(end.altitude_msl, 900, 2) << engine << " from " << airspeed;
    }
}

}  // namespace
}  // namespace skein::autopilot::energy_control_test
