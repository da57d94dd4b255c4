// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/detour_planner.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/base/random.h"

namespace skein::reasoning::detour_planner_test {
namespace {

Zone disc(const Vec2& centre, double radius) {
  return {.area = Disc{centre, radius}};
}

Zone box(const Vec2& low, const Vec2& high) {
  return {.area = geo::Ring{low, {high.x(), low.y()}, high, {low.x(), high.y()}}};
}

double length(const Vec2& from, const std::vector<Vec2>& route) {
  double sum = 0;
  Vec2 last = from;
  for (const Vec2& p : route) sum += (p - last).norm(), last = p;
  return sum;
}

TEST(DetourPlanner, WithoutZonesAllIsStraight) {
  const DetourPlanner detours({}, 50);
  EXPECT_TRUE(detours.allows({0, 0}, {1000, 0}));
  EXPECT_EQ(detours.nearest_allowed({3, 4}), Vec2(3, 4));
  EXPECT_EQ(detours.detour({0, 0}, {9, 9}), std::vector<Vec2>{Vec2(9, 9)});
}

TEST(DetourPlanner, TheNearestPlaceIsOutsideByTheClearance) {
  const std::vector<Zone> zones{disc({0, 0}, 300)};
  const DetourPlanner detours(zones, 100);
  const Vec2 place = detours.nearest_allowed({30, 40});
  // The outline is a polygon around the disc; it, arcs and the place add 3 m each, arcs
  // twice.
  EXPECT_GE(place.norm(), 400);
  EXPECT_LT(place.norm(), 412);
  EXPECT_GT(place.normalized().dot(Vec2(0.6, 0.8)), 0.99);
  EXPECT_TRUE(detours.allows(place));
  EXPECT_EQ(detours.nearest_allowed({500, 0}), Vec2(500, 0));
}

TEST(DetourPlanner, OverlappingZonesAreLeftTogether) {
  const std::vector<Zone> zones{box({-100, -100}, {100, 100}),
                                box({50, -300}, {90, 300})};
  const DetourPlanner detours(zones, 20);
  const Vec2 place = detours.nearest_allowed({60, 0});
  EXPECT_TRUE(detours.allows(place));
  EXPECT_NEAR(place.x(), 126, 3);
}

TEST(DetourPlanner, AroundADiscItIsTwoTangentsAndAnArc) {
  const std::vector<Zone> zones{disc({0, 0}, 300)};
  const DetourPlanner detours(zones, 100);
  const Vec2 from(-1000, 0), to(1000, 20);
  const std::vector<Vec2> route = detours.detour(from, to);
  // Towards `to` it need not turn back as far as it turned out.
  const double r = 400, d = 1000, turned = 2 * std::asin(r / d) - std::atan2(20, 1000);
  const double exact = 2 * std::sqrt(d * d - r * r) + r * turned;
  // A polygon some metres around the circle.
  EXPECT_GT(length(from, route), exact * 0.999 - 2);
  EXPECT_LT(length(from, route), exact * 1.03);
  EXPECT_EQ(route.back(), to);
}

TEST(DetourPlanner, AStartWithinTheClearanceLeavesFirst) {
  const std::vector<Zone> zones{disc({0, 0}, 300)};
  const DetourPlanner detours(zones, 100);
  const std::vector<Vec2> route = detours.detour({-350, 0}, {1000, 0});
  EXPECT_NEAR(route.front().x(), -406, 6);
  EXPECT_EQ(route.back(), Vec2(1000, 0));
  // A goal within becomes the nearest place.
  EXPECT_TRUE(detours.allows(detours.detour({-1000, 0}, {0, 10}).back()));
}

// Out of a bay: the straight line runs into its bottom.
TEST(DetourPlanner, LeadsOutOfABay) {
  const Zone bay{.area = geo::Ring{{-400, -500},
                                   {600, -500},
                                   {600, 500},
                                   {-400, 500},
                                   {-400, 300},
                                   {400, 300},
                                   {400, -300},
                                   {-400, -300}}};
  const std::vector<Zone> zones{bay};
  const DetourPlanner detours(zones, 50);
  const Vec2 from(200, 0), to(1200, 0);
  std::vector<Vec2> route = detours.detour(from, to);
  EXPECT_GE(route.size(), 3u);
  Vec2 last = from;
  for (const Vec2& p : route) {
    EXPECT_TRUE(detours.allows(last, p));
    last = p;
  }
  EXPECT_EQ(last, to);
}

TEST(DetourPlanner, WhoIsShutInIsLedStraight) {
  // A ring of four walls around the start.
  const std::vector<Zone> zones{
      box({-500, -500}, {-400, 500}), box({400, -500}, {500, 500}),
      box({-500, -500}, {500, -400}), box({-500, 400}, {500, 500})};
  const DetourPlanner detours(zones, 20);
  // It is sent out to where it may be: nobody is left within.
  const std::vector<Vec2> route = detours.detour({0, 0}, {2000, 0});
  EXPECT_EQ(route.back(), Vec2(2000, 0));
  EXPECT_GT(route.front().cwiseAbs().maxCoeff(), 500);
}

// No path over any grid of places is shorter than the one that is found by more than the
// corners are outside, and all its legs are allowed.
TEST(DetourPlanner, PathsAreAllowedAndNoneIsShorter) {
  for (std::uint32_t run = 0; run < 60; ++run) {
    RandomStream random(1, run, Purpose::kTest);
    std::vector<Zone> zones;
    for (int k = 0; k < 6; ++k) {
      const Vec2 at(random.uniform(-800, 800), random.uniform(-600, 600));
      if (k % 2 == 0)
        zones.push_back(disc(at, random.uniform(50, 250)));
      else
        zones.push_back(
            box(at, at + Vec2(random.uniform(50, 400), random.uniform(50, 400))));
    }
    const DetourPlanner detours(zones, 40);
    const Vec2 from(-1300, random.uniform(-500, 500)),
        to(1300, random.uniform(-500, 500));
    const std::vector<Vec2> route = detours.detour(from, to);
    Vec2 last = from;
    for (const Vec2& p : route) {
      ASSERT_TRUE(detours.allows(last, p)) << "run " << run;
      last = p;
    }
    ASSERT_EQ(last, to);
    // Random detours by up to three places, as a search that knows nothing of corners.
    double best = (to - from).norm();
    ASSERT_GE(length(from, route), best - 1e-9);
    best = 1e9;
    for (int k = 0; k < 400; ++k) {
      std::vector<Vec2> other;
      const int places = static_cast<int>(random.uniform(0, 4));
      for (int i = 0; i < places; ++i)
        other.push_back(from + (i + random.uniform()) / places * (to - from) +
                        Vec2(0, random.uniform(-700, 700)));
      other.push_back(to);
      bool free = true;
      Vec2 at = from;
      for (const Vec2& p : other) free = free && detours.allows(at, p), at = p;
      if (free) best = std::min(best, length(from, other));
    }
    // Each bend is up to 13 m further out than the area that is not allowed.
    ASSERT_LT(length(from, route), best + 13.0 * 2 * static_cast<double>(route.size()))
        << "run " << run;
  }
}

}  // namespace
}  // namespace skein::reasoning::detour_planner_test
