// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/modes/home_energy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/base/random.h"

namespace skein::autopilot::home_energy_test {
namespace {

HomeFlight flight() {
  return {.airspeed = 15,
          .climb_rate = 2,
          .sink_rate = 3,
          .power_level = 60,
          .power_climb = 120,
          .power_sink = 10,
          .landing_time = 30};
}

TEST(GroundSpeedAlong, SolvesTheWindTriangle) {
  RandomStream random(5, 0, Purpose::kTest);
  for (int k = 0; k < 1000; ++k) {
    const double course = random.uniform(-geo::kPi, geo::kPi);
    const Vec2 direction = geo::unit(course);
    const Vec2 wind(random.normal() * 5, random.normal() * 5);
    const double speed = ground_speed_along(direction, 15, wind);
    // The air velocity that is left has the airspeed's length.
    if (speed > 0) {
      EXPECT_NEAR((speed * direction - wind).norm(), 15, 1e-12);
    } else {
      EXPECT_GT(wind.norm(), 15);
    }
  }
}

TEST(GroundSpeedAlong, IsZeroWhereTheWindDoesNotLetIt) {
  EXPECT_EQ(ground_speed_along({1, 0}, 15, {-15, 0}), 0);
  EXPECT_EQ(ground_speed_along({1, 0}, 15, {-20, 0}), 0);
  EXPECT_EQ(ground_speed_along({1, 0}, 15, {0, 16}), 0);
  EXPECT_EQ(ground_speed_along({1, 0}, 15, {5, 0}), 20);
}

TEST(HomeNeed, AddsUpThePath) {
  const HomeNeed calm = home_need({0, 1500}, 300, Vec2::Zero(), flight());
  EXPECT_DOUBLE_EQ(calm.time, 100 + 30 + 100);
  EXPECT_DOUBLE_EQ(calm.energy, 60 * 130 + 10 * 100);
  const HomeNeed headwind = home_need({0, 1500}, 300, {0, -5}, flight());
  EXPECT_DOUBLE_EQ(headwind.time, 150 + 30 + 100);
  const HomeNeed below = home_need({0, 1500}, -100, Vec2::Zero(), flight());
  EXPECT_DOUBLE_EQ(below.energy, 60 * 130 + 120 * 50);
}

TEST(HomeNeed, AtHomeOnlyTheLandingIsLeft) {
  const HomeNeed need = home_need(Vec2::Zero(), 0, {40, 0}, flight());
  EXPECT_DOUBLE_EQ(need.time, 30);
  EXPECT_DOUBLE_EQ(need.energy, 1800);
}

TEST(HomeNeed, IsInfiniteAgainstTooMuchWind) {
  const HomeNeed need = home_need({100, 0}, 50, {-16, 0}, flight());
  EXPECT_TRUE(std::isinf(need.time));
  EXPECT_TRUE(std::isinf(need.energy));
}

TEST(HomeNeed, CountsInCharge) {
  HomeFlight f = flight();
  const double in_joules = home_need({0, 900}, 60, {0, 3}, f).energy;
  const double capacity = 80e3;  // [J]
  f.power_level /= capacity;
  f.power_climb /= capacity;
  f.power_sink /= capacity;
  EXPECT_NEAR(home_need({0, 900}, 60, {0, 3}, f).energy, in_joules / capacity, 1e-15);
}

}  // namespace
}  // namespace skein::autopilot::home_energy_test
