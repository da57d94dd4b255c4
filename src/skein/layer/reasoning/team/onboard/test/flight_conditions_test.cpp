// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/onboard/flight_conditions.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::reasoning::flight_conditions_test {
namespace {

TEST(TimeInWind, IsThatOfTheGroundSpeedAlongTheLeg) {
  EXPECT_DOUBLE_EQ(*time_in_wind({1000, 0}, 20, {0, 0}), 50);
  EXPECT_DOUBLE_EQ(*time_in_wind({1000, 0}, 20, {5, 0}), 40);
  EXPECT_DOUBLE_EQ(*time_in_wind({1000, 0}, 20, {-10, 0}), 100);
  EXPECT_DOUBLE_EQ(*time_in_wind({1000, 0}, 20, {0, 12}), 1000.0 / 16);
  EXPECT_DOUBLE_EQ(*time_in_wind({0, 0}, 20, {30, 0}), 0);
  EXPECT_FALSE(time_in_wind({1000, 0}, 20, {-20, 0}));
  EXPECT_FALSE(time_in_wind({1000, 0}, 20, {0, 21}));
}

Zone box(double south, double west, double north, double east) {
  Zone zone;
  zone.area = geo::Ring{{south, west}, {north, west}, {north, east}, {south, east}};
  return zone;
}

TEST(FlightConditions, WaysLeadAroundZones) {
  FlightConditions conditions;
  EXPECT_DOUBLE_EQ(*conditions.time({0, 0}, {2000, 0}, 20), 100);
  conditions.set_zones(std::vector{box(900, -1000, 1100, 500)}, 100, 0);
  // Around its east side, and the clearance: by 1000 m and back, or a little less.
  const double time = *conditions.time({0, 0}, {2000, 0}, 20);
  const double least = 2 * std::hypot(900, 530) / 20 + 200.0 / 20;
  EXPECT_GT(time, least - 1);
  EXPECT_LT(time, least + 5);
  EXPECT_DOUBLE_EQ(*conditions.time({0, 800}, {2000, 800}, 20), 100);
}

TEST(FlightConditions, TheWindIsThatOnEachLeg) {
  FlightConditions calm, windy;
  const std::vector zones = {box(900, -1000, 1100, 500)};
  calm.set_zones(zones, 100, 0);
  windy.set_zones(zones, 100, 0);
  windy.set_wind({8, 0});
  EXPECT_LT(*windy.time({0, 0}, {2000, 0}, 20), *calm.time({0, 0}, {2000, 0}, 20));
  EXPECT_GT(*windy.time({2000, 0}, {0, 0}, 20), *calm.time({2000, 0}, {0, 0}, 20));
  windy.set_wind({0, -25});
  EXPECT_FALSE(windy.time({0, 0}, {2000, 0}, 20));
}

TEST(FlightConditions, ZonesCountAtTheirAltitudesAndTimes) {
  Zone zone = box(900, -1000, 1100, 500);
  zone.floor_msl = 300;
  zone.from = 1000;
  FlightConditions conditions;
  const auto time = [&](double altitude, double now) {
    conditions.set_zones({&zone, 1}, altitude, now);
    return *conditions.time({0, 0}, {2000, 0}, 20);
  };
  EXPECT_DOUBLE_EQ(time(100, 2000), 100);
  EXPECT_DOUBLE_EQ(time(400, 0), 100);
  EXPECT_GT(time(400, 950), 105);
  EXPECT_GT(time(290, 2000), 105);
}

}  // namespace
}  // namespace skein::reasoning::flight_conditions_test
