// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/flight_goal.h"

#include <gtest/gtest.h>

namespace skein::reasoning::flight_goal_test {
namespace {

NavEstimate north_at_20() {
  NavEstimate nav;
  nav.p_N = Vec3(0, 0, -100);
  nav.v_N = Vec3(20, 0, -1);
  return nav;
}

TEST(FlightGoal, IsStraightOnWithoutAFlight) {
  const model::FlightGoal goal = goal_of(nullptr, 0, north_at_20(), 0);
  EXPECT_EQ(goal.track, 0);
  EXPECT_EQ(goal.speed, 20);
  EXPECT_EQ(goal.vertical_speed, 0);
  EXPECT_EQ(goal.altitude, 100);
}

TEST(FlightGoal, IsWhereAPlanLeadsAMinuteLater) {
  FlightElement climb;  // east, to 60 m more
  climb.duration = 200;
  climb.airspeed = 20;
  climb.heading = geo::kPi / 2;
  climb.climb_rate = 1;
  climb.p_N = Vec3(0, 0, -100);
  const FlightIntent intent{1, Itinerary{{climb}, {200}, true, true, false}};
  const model::FlightGoal goal = goal_of(&intent, 0, north_at_20(), 0);
  EXPECT_NEAR(goal.track, geo::kPi / 2, 1e-9);
  EXPECT_NEAR(goal.vertical_speed, 1, 1e-9);
  EXPECT_NEAR(goal.altitude.value(), 160, 1e-6);
}

TEST(FlightGoal, IsTheNextPointOfALap) {
  Legs legs;
  legs.points = {{500, 0}, {500, 500}, {0, -500}};
  legs.laps = 2;
  const FlightIntent intent{1, legs};
  EXPECT_NEAR(goal_of(&intent, 1, north_at_20(), 0).track, geo::kPi / 4, 1e-9);
  EXPECT_NEAR(goal_of(&intent, 5, north_at_20(), 0).track, -geo::kPi / 2, 1e-9);
  EXPECT_NEAR(goal_of(&intent, 9, north_at_20(), 0).track, -geo::kPi / 2, 1e-9)
      << "the last one, when all have been passed";
}

TEST(FlightGoal, IsItsOwnCourseWhereItCircles) {
  const FlightIntent near{0, Circling{Vec2(0, 100), {}}};
  EXPECT_EQ(goal_of(&near, 0, north_at_20(), 0).track, 0);
  const FlightIntent far{0, Circling{Vec2(0, 1000), {}}};
  EXPECT_NEAR(goal_of(&far, 0, north_at_20(), 0).track, geo::kPi / 2, 1e-9);
}

}  // namespace
}  // namespace skein::reasoning::flight_goal_test
