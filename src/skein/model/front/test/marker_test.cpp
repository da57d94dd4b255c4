// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "skein/base/random.h"
#include "skein/geo/clip.h"
#include "skein/model/front/crossing.h"
#include "skein/model/front/spacing.h"

namespace skein::model::marker_test {
namespace {

using geo::kPi;

geo::Ring circle(double radius, int count) {
  geo::Ring ring;
  for (int i = 0; i < count; ++i) ring.push_back(radius * geo::unit(2 * kPi * i / count));
  return ring;
}

TEST(Respace, KeepsEdgesBetweenItsBounds) {
  RandomStream random(1, 0, Purpose::kTest);
  geo::Ring ring, scratch;
  double bearing = 0;
  while (bearing < 2 * kPi) {  // a circle with most uneven spacing
    ring.push_back(300 * geo::unit(bearing));
    bearing += random.uniform(0.001, 0.2);
  }
  respace(ring, 10, scratch);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const double edge = (ring[(i + 1) % ring.size()] - ring[i]).norm();
    EXPECT_LE(edge,
              kLongestEdge * 10 * 1.05);  // the arc's height lengthens halves a little
    EXPECT_GE(edge, kShortestEdge * 10 * 0.9);
  }
}

TEST(Respace, RefiningACircleKeepsItsArea) {
  geo::Ring ring = circle(100, 24), scratch;  // edges 26 m; the polygon lacks 1.1 %
  for (double spacing : {13.0, 7.0, 4.0}) respace(ring, spacing, scratch);
  EXPECT_NEAR(geo::signed_area(ring) / (kPi * 100 * 100), 1, 2e-3);
}

TEST(Respace, DoesNotRoundASquare) {
  geo::Ring ring = {{0, 0}, {100, 0}, {100, 100}, {0, 100}}, scratch;
  respace(ring, 10, scratch);
  EXPECT_NEAR(geo::signed_area(ring), 1e4, 1e-6);
  EXPECT_GE(ring.size(), 28u);
}

TEST(CutLoops, CutsAFoldAndKeepsTheRest) {
  // A square whose northern side has a small crossed fold.
  geo::Ring ring;
  for (int i = 0; i <= 10; ++i) ring.emplace_back(10.0 * i, 0);
  for (int i = 1; i <= 4; ++i) ring.emplace_back(100, 10.0 * i);
  ring.emplace_back(98, 53);
  ring.emplace_back(98, 47);
  for (int i = 6; i <= 10; ++i) ring.emplace_back(100, 10.0 * i);
  for (int i = 9; i >= 0; --i) ring.emplace_back(10.0 * i, 100);
  for (int i = 9; i >= 1; --i) ring.emplace_back(0, 10.0 * i);
  CrossingSearch search;
  ASSERT_TRUE(search.any({ring}, 20));
  cut_loops(ring, 50);
  EXPECT_FALSE(search.any({ring}, 20));
  // clean() rounds to 0.1 mm, over 400 m of boundary.
  EXPECT_NEAR(geo::signed_area(ring),
              geo::area(geo::clean({ring}, geo::FillRule::kPositive)), 0.02);
}

TEST(CrossingSearch, AgreesWithTestingEveryPair) {
  RandomStream random(2, 0, Purpose::kTest);
  CrossingSearch search;
  int crossing = 0;
  for (int trial = 0; trial < 400; ++trial) {
    geo::Ring ring;
    const double noise = random.uniform(0, 7);
    for (const Vec2& p : circle(100, 60)) {
      const double north = random.normal(), east = random.normal();
      ring.push_back(p + noise * Vec2(north, east));
    }
    bool any = false;
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 2; j < n; ++j)
        if (!(i == 0 && j + 1 == n))
          any |= segments_cross(ring[i], ring[i + 1], ring[j], ring[(j + 1) % n]);
    EXPECT_EQ(search.any({ring}, 20), any);
    crossing += any;
  }
  EXPECT_GT(crossing, 50);
  EXPECT_LT(crossing, 350);
}

TEST(CrossingSearch, SeesTwoRingsThatOverlap) {
  CrossingSearch search;
  geo::Ring other = circle(100, 60);
  for (Vec2& p : other) p += Vec2(150, 3);
  EXPECT_TRUE(search.any({circle(100, 60), other}, 20));
  for (Vec2& p : other) p += Vec2(60, 0);
  EXPECT_FALSE(search.any({circle(100, 60), other}, 20));
}

}  // namespace
}  // namespace skein::model::marker_test
