// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/passage_log.h"

#include <gtest/gtest.h>

namespace skein::mixed::passage_log_test {
namespace {

Time second(double seconds) {
  return Time::from_seconds(seconds);
}

constexpr EntityId kFirst{1}, kSecond{2};

// A mast of radius 2 m, 20 m high, at 100 m north, on ground at 50 m.
Cylinder mast() {
  return {{100, 0}, 2, 50, 70};
}

// North at 10 m/s, `east` of the mast, at an altitude; from time `from` on for 20 s.
void fly_by(PassageLog& log, EntityId who, double east, double altitude, double from) {
  for (int k = 0; k <= 200; ++k)
    log.add(second(from + 0.1 * k), who, {1.0 * k, east, -altitude});
}

TEST(Cylinder, DistanceIsToItsSurface) {
  EXPECT_EQ(mast().distance({100, 1, -60}), 0);
  EXPECT_DOUBLE_EQ(mast().distance({100, 7, -60}), 5);
  EXPECT_DOUBLE_EQ(mast().distance({100, 0, -75}), 5);
  EXPECT_DOUBLE_EQ(mast().distance({100, 0, -40}), 10) << "below its foot";
  EXPECT_DOUBLE_EQ(mast().distance({100, 5, -74}), 5) << "3 m aside, 4 m above";
}

TEST(PassageLog, FindsWhoPassedWhenAndHowNear) {
  PassageLog log;
  fly_by(log, kFirst, 8, 60, 0);
  fly_by(log, kSecond, 40, 60, 0);
  const auto found = log.nearest(mast(), second(0), second(100), 10);
  ASSERT_EQ(found.size(), 1u) << "the second passed at 38 m";
  EXPECT_EQ(found[0].aircraft, kFirst);
  // Between two points half a second apart; the path is straight.
  EXPECT_NEAR(found[0].distance, 6, 1e-6);
  EXPECT_NEAR(found[0].time.seconds(), 10, 0.01);
}

TEST(PassageLog, HighAboveIsNotNear) {
  PassageLog log;
  fly_by(log, kFirst, 0, 85, 0);
  EXPECT_TRUE(log.nearest(mast(), second(0), second(100), 10).empty());
  EXPECT_EQ(log.nearest(mast(), second(0), second(100), 16).size(), 1u);
}

TEST(PassageLog, OnlyTheAskedTimeCounts) {
  PassageLog log;
  fly_by(log, kFirst, 0, 60, 0);
  EXPECT_TRUE(log.nearest(mast(), second(0), second(8), 10).empty());
  EXPECT_TRUE(log.nearest(mast(), second(12), second(100), 10).empty());
  EXPECT_EQ(log.nearest(mast(), second(8), second(12), 10).size(), 1u);
}

TEST(PassageLog, TheNearestOfSeveralPassagesIsGiven) {
  PassageLog log;
  fly_by(log, kFirst, 9, 60, 0);
  fly_by(log, kFirst, 5, 60, 50);
  const auto found = log.nearest(mast(), second(0), second(100), 10);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].distance, 3, 1e-6);
  EXPECT_NEAR(found[0].time.seconds(), 60, 0.01);
}

TEST(PassageLog, WhoWasAwayHasNotFlownBetween) {
  PassageLog log;
  log.add(second(0), kFirst, {0, 0, -60});
  log.add(second(60), kFirst, {200, 0, -60});
  EXPECT_TRUE(log.nearest(mast(), second(0), second(100), 10).empty());
}

TEST(PassageLog, HoldsABoundedNumberOfPoints) {
  PassageLog log;
  log.add(second(0), kFirst, {100, 0, -60});
  for (std::size_t k = 1; k <= PassageLog::kMaxPoints; ++k)
    log.add(second(0.5 * static_cast<double>(k)), kFirst, {1000, 0, -60});
  EXPECT_TRUE(log.nearest(mast(), second(0), second(0), 10).empty())
      << "the first point is gone";
}

}  // namespace
}  // namespace skein::mixed::passage_log_test
