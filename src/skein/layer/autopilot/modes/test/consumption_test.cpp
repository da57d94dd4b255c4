// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/modes/consumption.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::autopilot::consumption_test {
namespace {

Time at(double seconds) {
  return Time::from_seconds(seconds);
}

TEST(Consumption, KnowsNothingAtFirst) {
  Consumption consumption({});
  EXPECT_FALSE(consumption.endurance());
  consumption.sense(at(0), 0.9);
  EXPECT_EQ(consumption.rate(), 0);
  EXPECT_FALSE(consumption.endurance());
}

TEST(Consumption, FindsASteadyRateFromTheSecondSampleOn) {
  Consumption consumption({});
  for (int k = 0; k <= 500; ++k) {
    const double charge = 0.9 - 0.001 * k;
    consumption.sense(at(k), charge);
    if (k == 0) continue;
    // 1e-12: rounding of differences of charges of size 1 over 1 s, averaged.
    ASSERT_NEAR(consumption.rate(), 0.001, 1e-12);
    ASSERT_NEAR(*consumption.endurance(), charge / 0.001, 1e-6);
  }
}

TEST(Consumption, FollowsAChangeWithItsLag) {
  Consumption consumption({.lag = 20});
  double charge = 1, t = 0;
  const auto fly = [&](double seconds, double rate) {
    for (const double end = t + seconds; t < end - 1e-9;) {
      t += 0.1;
      charge -= 0.1 * rate;
      consumption.sense(at(t), charge);
    }
  };
  fly(100, 1e-3);
  fly(20, 2e-3);
  // One lag after the step: 1 - 1/e of it. 1 %: steps of 0.1 s against the continuous
  // lag.
  EXPECT_NEAR(consumption.rate(), 1e-3 * (2 - std::exp(-1.0)), 1e-5);
}

TEST(Consumption, AGlideDoesNotMakeThePathHomeFree) {
  Consumption consumption({});
  double charge = 1;
  for (int k = 0; k <= 600; ++k) {
    if (k > 0 && k <= 300) charge -= 1e-3;
    consumption.sense(at(k), charge);
  }
  EXPECT_LT(consumption.rate(), 1e-6);
  HomeFlight flight;
  consumption.set_powers(flight);
  EXPECT_NEAR(flight.power_level, 0.5e-3, 1e-12);  // half of the time under power
  EXPECT_DOUBLE_EQ(flight.power_climb, 1.8 * flight.power_level);
  EXPECT_DOUBLE_EQ(flight.power_sink, 0.4 * flight.power_level);
}

}  // namespace
}  // namespace skein::autopilot::consumption_test
