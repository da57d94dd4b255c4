// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/flights/held_circle.h"

#include <gtest/gtest.h>

#include "skein/model/path/flight_plan.h"

namespace skein::reasoning::held_circle_test {
namespace {

// Straight on for a minute, then around.
FlightPlan circling(double turns, double climb_rate = 0, double side = 1) {
  FlightElement straight;
  straight.p_N = Vec3(0, 0, -100);
  straight.airspeed = 20;
  straight.duration = 60;
  FlightPlan plan{straight};
  for (double left = turns; left > 0; left -= 0.25) {
    const model::FlightMoment m = model::end_of(plan.back());
    FlightElement turn;
    turn.start = model::end_time_of(plan);
    turn.p_N = m.p_N;
    turn.heading = m.heading;
    turn.airspeed = 20;
    turn.turn_rate = side * 0.25;
    turn.climb_rate = climb_rate;
    turn.duration = geo::kPi / 2 / 0.25;
    plan.push_back(turn);
  }
  return plan;
}

TEST(HeldCircle, IsTheLastFullTurnOfAPlan) {
  for (const double side : {1.0, -1.0}) {
    const auto circle = circle_at_end(circling(2.5, 0, side));
    ASSERT_TRUE(circle);
    EXPECT_NEAR(circle->radius, 80, 1);
    EXPECT_LT((circle->centre - Vec2(1200, side * 80)).norm(), 1);
    EXPECT_NEAR(circle->down, -100, 1e-9);
  }
}

TEST(HeldCircle, IsNoneWhereAPlanEndsOtherwise) {
  EXPECT_FALSE(circle_at_end({}));
  EXPECT_FALSE(circle_at_end(circling(0)));
  EXPECT_FALSE(circle_at_end(circling(0.75)));
  EXPECT_FALSE(circle_at_end(circling(2, 1))) << "it climbs";
  FlightPlan leaves = circling(2);
  FlightElement straight = leaves.front();
  straight.start = model::end_time_of(leaves);
  straight.p_N = model::end_of(leaves.back()).p_N;
  leaves.push_back(straight);
  EXPECT_FALSE(circle_at_end(leaves));
}

TEST(HeldCircle, CirclesAreApartByBothRadiiOrInHeight) {
  const HeldCircle a{{0, 0}, 80, -100, {}}, b{{200, 0}, 80, -100, {}};
  EXPECT_FALSE(are_apart(a, b, {50, 20}));
  EXPECT_TRUE(are_apart(a, b, {40, 20}));
  EXPECT_TRUE(are_apart(a, {{10, 0}, 80, -121, {}}, {50, 20}));
}

}  // namespace
}  // namespace skein::reasoning::held_circle_test
