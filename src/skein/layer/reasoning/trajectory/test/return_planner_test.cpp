// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/return_planner.h"

#include <gtest/gtest.h>

#include "skein/layer/reasoning/trajectory/test/test_flight.h"

namespace skein::reasoning::return_planner_test {
namespace {

Zone disc(const Vec2& centre, double radius) {
  return {.area = Disc{centre, radius}};
}

// Ground at 100 m, flight at 220 m.
struct Harness {
  AgentOutput at(double time, const Vec2& place, const std::vector<Zone>& zones,
                 bool changed) {
    aircraft.p.head<2>() = place;
    nav = aircraft.nav(Time::from_seconds(time));
    AgentInput in;
    in.now = nav.time;
    in.nav = &nav;
    AgentOutput out;
    planner.step(in, {0, 0}, zones, changed, out);
    return out;
  }
  test::FlatGround ground;
  test::TestAircraft aircraft;
  NavEstimate nav;
  ReturnPlanner planner{{}, FlightLimits{}, EntityId{1}, ground};
};

TEST(ReturnPlanner, SaysNothingWithoutNeed) {
  Harness harness;
  EXPECT_FALSE(harness.at(0, {500, 0}, {}, false).return_route);
  const AgentOutput out = harness.at(1, {500, 0}, {disc({5000, 5000}, 300)}, true);
  EXPECT_FALSE(out.return_route);
  EXPECT_TRUE(out.events.empty());
}

TEST(ReturnPlanner, MovesHomeOutOfAZoneAndBack) {
  Harness harness;
  const std::vector<Zone> zones{disc({-50, 0}, 300)};
  const AgentOutput out = harness.at(1, {2000, 0}, zones, true);
  ASSERT_TRUE(out.return_route);
  ASSERT_EQ(out.return_route->points.size(), 1u);
  // Radius, margin of 30 m and a circle of 1.15 times 60 m.
  const Vec2 place = out.return_route->points[0];
  EXPECT_NEAR((place - Vec2(-50, 0)).norm(), 300 + 30 + 69 + 6, 6);
  EXPECT_GT(place.x(), 300);  // to the side that is nearest
  EXPECT_DOUBLE_EQ(out.return_route->ground_msl, 100);
  ASSERT_EQ(out.events.size(), 1u);
  EXPECT_EQ(out.events[0].kind, EventKind::kReturnMoved);
  EXPECT_EQ(harness.planner.allowed({0, 0}), place);
  EXPECT_FALSE(harness.at(2.5, {1900, 0}, zones, false).return_route);
  const AgentOutput back = harness.at(3, {1800, 0}, {}, true);
  ASSERT_TRUE(back.return_route);
  EXPECT_TRUE(back.return_route->points.empty());
  EXPECT_EQ(back.events.at(0).text, "returns lead home again");
}

TEST(ReturnPlanner, CountsZonesBetweenTheGroundAndTheFlight) {
  const auto moved = [](Zone zone) {
    Harness harness;
    return harness.at(1, {2000, 0}, {zone}, true).return_route.has_value();
  };
  Zone high = disc({0, 0}, 300);
  high.floor_msl = 241;  // 20 m of margin above the flight at 220 m
  EXPECT_FALSE(moved(high));
  high.floor_msl = 239;
  EXPECT_TRUE(moved(high));
  Zone low = disc({0, 0}, 300);
  low.ceiling_msl = 150;  // a landing would lead through it
  EXPECT_TRUE(moved(low));
  low.ceiling_msl = 99;
  EXPECT_FALSE(moved(low));
  Zone later = disc({0, 0}, 300);
  later.from = 602;
  EXPECT_FALSE(moved(later));
  later.from = 600;
  EXPECT_TRUE(moved(later));
}

TEST(ReturnPlanner, LeadsAroundAZoneAndDropsCornersThatLieBehind) {
  Harness harness;
  const Zone wall{.area = geo::Ring{{500, -400}, {700, -400}, {700, 300}, {500, 300}}};
  const std::vector<Zone> zones{wall};
  const AgentOutput out = harness.at(1, {1500, 0}, zones, true);
  ASSERT_TRUE(out.return_route);
  EXPECT_TRUE(out.events.empty());  // home is where it was
  std::vector<Vec2> route = out.return_route->points;
  ASSERT_GE(route.size(), 2u);
  EXPECT_EQ(route.back(), Vec2(0, 0));
  EXPECT_GT(route[0].y(), 300 + 30);  // the shorter side
  // Flown, it becomes shorter, and in the end straight.
  double time = 1;
  Vec2 p(1500, 0);
  for (int step = 0; step < 400 && !route.empty(); ++step) {
    p += 10 * (route.front() - p).normalized();
    time += 0.5;
    if (const auto next = harness.at(time, p, zones, false).return_route)
      route = next->points;
    EXPECT_FALSE(covers(wall, p));
  }
  EXPECT_TRUE(route.empty());
  EXPECT_LT(p.x(), 520);
}

}  // namespace
}  // namespace skein::reasoning::return_planner_test
