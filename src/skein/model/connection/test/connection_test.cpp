// SPDX-License-Identifier: Apache-2.0
#include "skein/model/connection/connection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "skein/model/connection/test/dense_search.h"

namespace skein::model::connection_test {
namespace {

void expect_exact(const ConnectionQuery& q, std::uint32_t number) {
  const Connection c = connect(q.from, q.to, q.air);
  ASSERT_EQ(c.status, ConnectionStatus::kFound) << number;
  // Rounding of positions of a thousand radii is 1e-13 radii; near-tangent straights and
  // strong wind magnify it.
  ASSERT_LT(test::end_error(q, c), 1e-8) << number << " " << name_of(c.word);
  const double reference = test::dense_search(q, c.time, 300);
  ASSERT_LE(c.time * (1 - 1e-9), reference) << number << " " << name_of(c.word);
}

TEST(Connection, IsNeverLaterThanADenseSearchOnRandomCases) {
  for (std::uint32_t i = 0; i < 3000; ++i) expect_exact(test::random_case(i), i);
}

TEST(Connection, IsNeverLaterThanADenseSearchOnHardCases) {
  for (std::uint32_t i = 0; i < 3000; ++i) expect_exact(test::hard_case(i), i);
}

TEST(Connection, NeverFailsWhileTheWindIsWeakerThanTheAirspeed) {
  for (std::uint32_t i = 0; i < 100'000; ++i) {
    const ConnectionQuery q = test::extreme_case(i);
    const Connection c = connect(q.from, q.to, q.air);
    ASSERT_EQ(c.status, ConnectionStatus::kFound) << i;
    // Rounding grows with the distance flown through the air.
    const double offset = c.time * q.air.airspeed / q.air.turn_radius;
    ASSERT_LT(test::end_error(q, c), 1e-10 * (1 + offset)) << i << " " << name_of(c.word);
  }
}

TEST(Connection, RefusesWhatHasNoAnswer) {
  const Pose from{{0, 0}, 0}, to{{500, 0}, 1};
  const double nan = std::nan("");
  EXPECT_EQ(connect(from, to, {15, 60, {15, 0}}).status,
            ConnectionStatus::kWindTooStrong);
  EXPECT_EQ(connect(from, to, {15, 60, {0, 40}}).status,
            ConnectionStatus::kWindTooStrong);
  EXPECT_EQ(connect(from, {{nan, 0}, 0}, {}).status, ConnectionStatus::kBadInput);
  EXPECT_EQ(connect({{0, 0}, nan}, to, {}).status, ConnectionStatus::kBadInput);
  EXPECT_EQ(connect(from, to, {15, 60, {nan, 0}}).status, ConnectionStatus::kBadInput);
  EXPECT_EQ(connect(from, to, {0, 60, {0, 0}}).status, ConnectionStatus::kBadInput);
  EXPECT_EQ(connect(from, to, {15, -1, {0, 0}}).status, ConnectionStatus::kBadInput);
  EXPECT_EQ(connect(from, {{1e300, 0}, 0}, {15, 60, {3, 0}}).status,
            ConnectionStatus::kBadInput);
  EXPECT_EQ(connect(from, {{5e10, 0}, 0}, {15, 60, {3, 0}}).status,
            ConnectionStatus::kFound);
  EXPECT_TRUE(std::isinf(connect(from, to, {15, -1, {0, 0}}).time));
  EXPECT_TRUE(to_flight_plan(connect(from, to, {15, -1, {0, 0}}), from, {}).empty());
}

TEST(Connection, ReportsTheIrregularZone) {
  const AirMotion air{15, 60, {0, 5}};
  // Across the wind the goal drifts towards the start, or stays more than 240 m away.
  EXPECT_TRUE(connect({{0, 0}, 0}, {{0, 200}, 0}, air).irregular);
  EXPECT_FALSE(connect({{0, 0}, 0}, {{2000, 0}, 0}, air).irregular);
  EXPECT_FALSE(connect({{0, 0}, 0}, {{0, 200}, 0}, {15, 60, {0, 0}}).irregular);
}

TEST(Connection, ABatchIsItsConnections) {
  std::vector<ConnectionQuery> queries;
  for (std::uint32_t i = 0; i < 100; ++i) queries.push_back(test::hard_case(i));
  std::vector<Connection> out(queries.size());
  connect(queries, out);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Connection one = connect(queries[i].from, queries[i].to, queries[i].air);
    EXPECT_EQ(out[i].time, one.time);
    EXPECT_EQ(out[i].word, one.word);
  }
}

TEST(Connection, TakesCoursesOverGround) {
  const AirMotion air{15, 60, {3, 4}};
  const auto heading = heading_pose({{10, 20}, 1.1}, air);
  ASSERT_TRUE(heading);
  const Vec2 over_ground = 15 * geo::unit(heading->course) + air.wind;
  EXPECT_NEAR(geo::bearing(over_ground), 1.1, 1e-12);
  EXPECT_FALSE(heading_pose({{10, 20}, 0}, {3, 60, {0, 4}}));
}

}  // namespace
}  // namespace skein::model::connection_test
