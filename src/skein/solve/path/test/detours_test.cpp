// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/detours.h"

#include <gtest/gtest.h>

#include "skein/base/random.h"
#include "skein/model/path/dubins.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/link.h"
#include "skein/solve/path/lower_bound.h"
#include "skein/solve/path/test/oracle.h"

namespace skein::solve::detours_test {
namespace {

const GroundSpeed kStill(20, Vec2(0, 0));

DetourRequest request(const Vec2& start, const Vec2& goal) {
  DetourRequest r;
  r.start = start;
  r.goal = goal;
  return r;
}

Detours around(const std::vector<Zone>& zones, const DetourRequest& r,
               const GroundSpeed& speed = kStill) {
  return detours_around(zones, {}, speed, r, {0, 0.02}, {});
}

// A taut string around a disc: two tangents and the arc between them.
TEST(Detours, OfAPointAroundADiscAreAsInTheTextbook) {
  const double d = 500, r = 200;
  const Detours detours =
      around({{Disc{Vec2(d, 0), r}}}, request(Vec2(0, 0), Vec2(2 * d, 0)));
  ASSERT_EQ(detours.detours.size(), 1u);
  const double length = 2 * std::sqrt(d * d - r * r) + r * 2 * std::asin(r / d);
  EXPECT_NEAR(detours.detours.front().time * 20, length, 1e-6);
}

TEST(Detours, OfAPointAroundASquarePassItsCorners) {
  const geo::Ring square = {Vec2(400, -100), Vec2(600, -100), Vec2(600, 300),
                            Vec2(400, 300)};
  const Detours detours = around({{square}}, request(Vec2(0, 0), Vec2(1000, 0)));
  ASSERT_EQ(detours.detours.size(), 1u);
  const double length = 2 * std::hypot(400, 100) + 200;
  // Two corners are passed 0.02 m away.
  EXPECT_NEAR(detours.detours.front().time * 20, length, 0.05);
}

// Without zones a curved route is the best of the four Dubins words with a straight.
TEST(Detours, OfAnAircraftAloneAreDubinsPaths) {
  RandomStream draw(4, 0, Purpose::kTest);
  for (int i = 0; i < 200; ++i) {
    DetourRequest r =
        request(Vec2(0, 0), Vec2(draw.uniform(300, 900), draw.uniform(-5, 900)));
    r.start_course = draw.uniform(-4, 4);
    r.goal_course = draw.uniform(-4, 4);
    r.turn_radius = 60;
    const Detours detours = around({}, r);
    ASSERT_EQ(detours.detours.size(), 1u);
    const model::DubinsPath best =
        model::dubins({r.start, r.start_course}, {r.goal, r.goal_course}, 60);
    EXPECT_NEAR(detours.detours.front().time * 20, best.length(), 1e-6) << i;
  }
}

TEST(Detours, AreNotLongerWithFewerZonesAndShorterOnesAreFoundFirst) {
  RandomStream draw(5, 0, Purpose::kTest);
  std::vector<Zone> zones;
  double before = 0;
  for (int i = 0; i < 40; ++i) {
    const Vec2 p(draw.uniform(200, 1800), draw.uniform(-600, 600));
    zones.push_back({Disc{p, draw.uniform(20, 90)}});
    DetourRequest r = request(Vec2(0, 0), Vec2(2000, 0));
    r.detours = 2;
    const Detours detours = around(zones, r);
    ASSERT_FALSE(detours.detours.empty());
    EXPECT_GE(detours.detours.front().time, before - 1e-9);
    before = detours.detours.front().time;
    if (detours.detours.size() > 1) {
      EXPECT_GE(detours.detours[1].time, before);
    }
  }
  EXPECT_GT(before, 100);  // they block the route
}

// A point's time in wind is never above that of any flight, whatever route that takes.
TEST(Detours, BoundFlightsInWind) {
  RandomStream draw(6, 0, Purpose::kTest);
  for (int i = 0; i < 40; ++i) {
    Airspace airspace;
    airspace.zones.push_back({Disc{Vec2(1000, draw.uniform(-100, 100)), 200}});
    PathQuery q;
    q.airspace = &airspace;
    q.start = {Vec3(0, 0, 0), draw.uniform(-3, 3)};
    q.goal = {Vec3(2000, 0, 0), draw.uniform(-3, 3)};
    q.wind = Vec2(draw.uniform(-9, 9), draw.uniform(-9, 9));
    SearchBudget budget(q.budget);
    const double bound = lower_bound(q, budget).time;
    for (int k = 0; k < 50; ++k) {
      const FlightState via{Vec3(draw.uniform(700, 1300), draw.uniform(-500, 500), 0),
                            draw.uniform(-3, 3)};
      const auto trajectory = make_trajectory({{q.start}, {via}, {q.goal}}, q);
      ASSERT_TRUE(trajectory);
      if (test::depth(airspace, to_flight_plan(*trajectory, q), 0.05) > 0) continue;
      EXPECT_LE(bound, trajectory->duration());
    }
  }
}

TEST(GroundSpeed, OfArcsIsTheSumOfShortStraights) {
  const Vec2 wind(-6, 9);
  const GroundSpeed speed(20, wind);
  for (const double turned : {0.3, -2.0, 6.0}) {
    constexpr int kPieces = 20000;
    double sum = 0;
    for (int i = 0; i < kPieces; ++i) {
      const double course = 1 + turned * (i + 0.5) / kPieces;
      sum += speed.straight(100 * std::abs(turned) / kPieces * geo::unit(course));
    }
    // Linear between 720 steps of a full turn.
    EXPECT_NEAR(speed.arc(100, 1, turned), sum, 1e-4 * sum);
  }
}

TEST(Links, ClimbInJustTheTimeNeeded) {
  PathQuery q;
  for (const double acceleration : {0.0, 1.0})
    for (const Vec2& wind : {Vec2(0, 0), Vec2(7, -8)}) {
      q.limits.climb_acceleration = acceleration;
      q.wind = wind;
      for (const double height : {10.0, 100.0, 400.0, -400.0}) {
        const FlightState from{Vec3(0, 0, -500), 1}, to{Vec3(600, 100, -500 - height), 2};
        const Link l = link(from, to, q);
        const FlightPlan plan = to_flight_plan(l, from, 7, q);
        EXPECT_LT((model::end_of(plan.back()).p_N - to.p_N).norm(), 1e-6);
        EXPECT_LT(test::gaps(plan), 1e-6);
        EXPECT_NEAR(model::duration(plan), l.duration, 1e-9);
        const double needed = climb_time(height, q.limits);
        for (const FlightElement& e : plan)
          EXPECT_LE(std::abs(e.climb_rate), 3 * (1 + 1e-9));
        if (acceleration > 0) {
          EXPECT_LT(test::climb_jump(plan), 1e-6);
          EXPECT_NEAR(needed, std::abs(height) / 3 + 3, 1e-9);
        }
        EXPECT_GE(l.duration, needed * (1 - 1e-9));
        // Without wind it takes no longer than needed, or a full turn more where less
        // than that is missing.
        if (!wind.isZero()) continue;
        const double alone = link(from, {Vec3(600, 100, -500), 2}, q).duration;
        EXPECT_LE(l.duration, std::max(alone + full_turn(q), needed * (1 + 1e-9)));
      }
    }
}

}  // namespace
}  // namespace skein::solve::detours_test
