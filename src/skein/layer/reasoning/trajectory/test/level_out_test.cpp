// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/level_out.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/model/path/flight_plan.h"

namespace skein::reasoning::level_out_test {
namespace {

NavEstimate banked(double roll) {
  NavEstimate nav;
  nav.p_N = {100, 200, -150};
  nav.heading = 1;
  nav.roll = roll;
  nav.wind_N = {3, -2};
  return nav;
}

FlightLimits wing() {
  FlightLimits limits;
  limits.airspeed = 20;
  limits.slowest = 14;
  return limits;
}

TEST(LevelOut, TakesLongerTheSteeperTheBankOnEitherSide) {
  const FlightState here{{100, 200, -150}, 1};
  EXPECT_FALSE(level_out(banked(0.1), wing(), here, 5));
  const auto some = level_out(banked(0.3), wing(), here, 5);
  const auto more = level_out(banked(-0.6), wing(), here, 5);
  ASSERT_TRUE(some && more);
  EXPECT_NEAR(more->duration, 2 * some->duration, 1e-9);
  EXPECT_EQ(some->start, 5);
  EXPECT_EQ(some->turn_rate, 0);
  EXPECT_EQ(some->wind, Vec2(3, -2));
  FlightLimits hovers = wing();
  hovers.slowest = 0;
  EXPECT_FALSE(level_out(banked(0.6), hovers, here, 5));
}

TEST(LevelOut, ACoordinatedTurnGoesOnUntilAnOrderComes) {
  const double roll = 0.5, delay = 2;
  const FlightState state = state_when_level(banked(roll), wing(), delay);
  const double rate = 9.80665 * std::tan(roll) / 20;
  EXPECT_NEAR(state.heading, 1 + rate * delay, 1e-6);
  // Half a circle of air, then the straight, both carried by the wind.
  const double radius = 20 / rate;
  Vec2 p = Vec2(100, 200) + delay * Vec2(3, -2) +
           radius * Vec2(std::sin(state.heading) - std::sin(1),
                         std::cos(1) - std::cos(state.heading));
  const auto level = level_out(banked(roll), wing(), {}, 0);
  p += level->duration * (20 * geo::unit(state.heading) + Vec2(3, -2));
  EXPECT_LT((geo::horizontal(state.p_N) - p).norm(), 1e-6);
  // Wings level it goes on straight.
  const FlightState straight = state_when_level(banked(0), wing(), delay);
  EXPECT_EQ(straight.heading, 1);
}

}  // namespace
}  // namespace skein::reasoning::level_out_test
