// SPDX-License-Identifier: Apache-2.0
#include "skein/data/perimeter/fire_report.h"

#include <gtest/gtest.h>

#include <limits>

#include "skein/data/describe/wire.h"

namespace skein::fire_report_test {
namespace {

TEST(FireReport, KeepsPlacesToTheDecimetreAndTimesToTheMillisecond) {
  const Time last = Time::from_seconds(100);
  const FireReading reading{
      Time::from_seconds(98.5), EntityId{4}, {-1234.56, 78.91}, 2, true};
  FireReport report{last, 2, {brief(reading, last, true)}, {brief(Vec2(5, -6))}};
  const FireReading back = reading_of(report, report.readings[0], EntityId{4});
  EXPECT_EQ(back.time, reading.time);
  EXPECT_EQ(back.aircraft, reading.aircraft);
  EXPECT_LE((back.point - reading.point).cwiseAbs().maxCoeff(), 0.05 + 1e-9);
  EXPECT_EQ(back.point_sd, 2);
  EXPECT_TRUE(back.inside);
  EXPECT_TRUE(report.readings[0].adjacent);
  const FireReading burning = reading_of(report, report.burning[0], EntityId{4});
  EXPECT_EQ(burning.time, last);
  EXPECT_EQ(burning.point, Vec2(5, -6));
  EXPECT_TRUE(burning.inside);
}

TEST(FireReport, IsShort) {
  const Time last = Time::from_seconds(1000);
  const FireReading reading{last, EntityId{4}, {-1234.5, 1978.9}, 2, true};
  FireReport report{last, 2, {brief(reading, last, false), brief(reading, last, true)}};
  const std::size_t pair = wire::coded_size(report);
  EXPECT_LE(pair, 42u);
  report.burning.assign(8, brief(Vec2(1234, -1978)));
  EXPECT_LE(wire::coded_size(report) - pair, 8u * 7);
}

TEST(FireReport, TakesAnyNumbers) {
  const double endless = std::numeric_limits<double>::infinity();
  for (const double each :
       {endless, -endless, std::numeric_limits<double>::quiet_NaN(), 1e300})
    EXPECT_LE(std::abs(brief(Vec2(each, -each)).north_dm), 1'000'000'000);
  const FireReading later{Time::from_seconds(5), EntityId{}, Vec2::Zero(), 0, false};
  EXPECT_EQ(brief(later, Time(), false).before_ms, 0u) << "after the last there is none";
}

}  // namespace
}  // namespace skein::fire_report_test
