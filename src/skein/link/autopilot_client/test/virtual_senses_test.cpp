// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/virtual_senses.h"

#include <gtest/gtest.h>

#include <limits>

namespace skein::autopilot_client::virtual_senses_test {
namespace {

TEST(VirtualSenses, ObstaclesAreCentimetresInTheFrameOfTheBody) {
  ObstacleDistances obstacles;
  obstacles.range = 100;
  obstacles.distances.fill(std::numeric_limits<double>::infinity());
  obstacles.distances[0] = 12.345;
  obstacles.distances[71] = 100;
  obstacles.distances[70] = 0;
  const mavlink::ObstacleDistance m = coded(obstacles, Time::from_seconds(2));
  EXPECT_EQ(m.time_usec, 2'000'000u);
  EXPECT_EQ(m.frame, 12);
  EXPECT_EQ(m.increment, 5);
  EXPECT_EQ(m.increment_f, 5);
  EXPECT_EQ(m.angle_offset, 0);
  EXPECT_EQ(m.max_distance, 10'000);
  EXPECT_EQ(m.distances[0], 1235);
  EXPECT_EQ(m.distances[1], 10'001);  // nothing in range
  EXPECT_EQ(m.distances[70], 0);
  EXPECT_EQ(m.distances[71], 10'000);
}

TEST(VirtualSenses, RangesThatNoMessageCanSayAreCut) {
  ObstacleDistances obstacles;
  obstacles.range = 5000;
  obstacles.distances.fill(700);
  const mavlink::ObstacleDistance m = coded(obstacles, Time());
  EXPECT_EQ(m.max_distance, 65'000);
  EXPECT_EQ(m.distances[5], 65'001);
}

TEST(VirtualSenses, PositionsHaveTheTimeOfSatellites) {
  const auto frame = geo::LocalFrame::at({47.0, 8.0, 0}).value();
  // 2024-01-01 00:00:00 UTC: a Monday, week 2295 of GPS, whose clock is 18 s ahead.
  const std::int64_t unix_ns = std::int64_t{1'704'067'200} * 1'000'000'000;
  const mavlink::GpsInput m =
      coded(PositionFix{{1000, -500, -120.5}, {1, 2, -3}, 1}, frame, unix_ns);
  EXPECT_EQ(m.time_week, 2295);
  EXPECT_EQ(m.time_week_ms, (24 * 3600 + 18) * 1000u);
  EXPECT_EQ(m.time_usec, 1'704'067'200'000'000u);
  const Vec2 place = frame.to_plane(m.lat * 1e-7, m.lon * 1e-7);
  EXPECT_LT((place - Vec2(1000, -500)).norm(), 0.02);  // a centimetre each way
  EXPECT_FLOAT_EQ(m.alt, 120.5F);
  EXPECT_FLOAT_EQ(m.vd, -3);
  EXPECT_EQ(m.fix_type, 3);
  EXPECT_EQ(m.ignore_flags, 0);
  EXPECT_LT(m.hdop, 1.4F);  // what ArduPilot arms with
}

}  // namespace
}  // namespace skein::autopilot_client::virtual_senses_test
