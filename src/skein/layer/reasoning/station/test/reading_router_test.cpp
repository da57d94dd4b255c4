// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/station/reading_router.h"

#include <gtest/gtest.h>

namespace skein::reasoning::reading_router_test {
namespace {

FireReading at(double north, double east) {
  FireReading reading;
  reading.point = {north, east};
  return reading;
}

TEST(ReadingRouter, GivesAllToTheOnlyPerimeterMission) {
  ReadingRouter router;
  router.set({{2, 0, {0, 0}}});
  EXPECT_TRUE(router.belongs(at(5000, 0), std::nullopt, 2));
  EXPECT_TRUE(router.belongs(at(5000, 0), 1, 2));
}

TEST(ReadingRouter, GivesAReadingToTheNearestPerimeterAndPrefersTheOwnOne) {
  ReadingRouter router;
  router.set({{0, 0, {0, 0}}, {1, 1, {0, 3000}}});
  EXPECT_TRUE(router.belongs(at(0, 1000), std::nullopt, 0));
  EXPECT_FALSE(router.belongs(at(0, 1000), std::nullopt, 1));
  EXPECT_TRUE(router.belongs(at(0, 1400), 1, 1)) << "its own, up to twice as far";
  EXPECT_FALSE(router.belongs(at(0, 1400), 1, 0));
  EXPECT_TRUE(router.belongs(at(0, 500), 1, 0)) << "on its way past the other fire";
}

TEST(ReadingRouter, MissionsAboutOnePerimeterShareItsReadings) {
  ReadingRouter router;
  router.set({{0, 4, {0, 0}}, {1, 4, {0, 300}}, {2, 5, {0, 5000}}});
  for (const std::size_t mission : {0, 1})
    EXPECT_TRUE(router.belongs(at(0, 100), std::nullopt, mission));
  EXPECT_FALSE(router.belongs(at(0, 100), std::nullopt, 2));
}

}  // namespace
}  // namespace skein::reasoning::reading_router_test
