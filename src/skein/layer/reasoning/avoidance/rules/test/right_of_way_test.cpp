// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/rules/right_of_way.h"

#include <gtest/gtest.h>

#include "skein/base/math.h"
#include "skein/base/random.h"

namespace skein::reasoning::right_of_way_test {
namespace {

AirMotionState at(double north, double east, double course_deg, double speed = 20,
                  double down_speed = 0) {
  const Vec2 v = speed * geo::unit(course_deg * geo::kPi / 180);
  return {Vec3(north, east, -100), Vec3(v.x(), v.y(), down_speed)};
}

AirRule rule(const AirMotionState& own, const AirMotionState& other, bool lower = true) {
  return rule_for(own, other, Standing::kEqual, lower);
}

TEST(RightOfWay, EachCaseOfTheRules) {
  const AirMotionState own = at(0, 0, 0);
  EXPECT_EQ(rule(own, at(1000, 0, 180)), AirRule::kHeadOn);
  EXPECT_EQ(rule(own, at(300, 0, 0, 12)), AirRule::kOvertaking);
  EXPECT_EQ(rule(own, at(-300, 0, 0, 30)), AirRule::kOvertaken);
  EXPECT_EQ(rule(own, at(1000, 1000, 270)), AirRule::kFromRight);
  EXPECT_EQ(rule(own, at(1000, -1000, 90)), AirRule::kFromLeft);
  EXPECT_EQ(rule(at(0, 0, 0, 20, -2), at(1000, 1000, 270)), AirRule::kClimbing);
  EXPECT_EQ(rule(own, at(1000, 1000, 270, 20, 2)), AirRule::kLevel);
  EXPECT_EQ(rule(own, at(0, 100, 0, 21), true), AirRule::kSlowHigher);
  EXPECT_EQ(rule(own, at(0, 100, 0, 21), false), AirRule::kSlowLower);
}

TEST(RightOfWay, AHigherClassFliesOn) {
  EXPECT_EQ(rule_for(at(0, 0, 0), at(1000, 0, 180), Standing::kOtherHigher, true),
            AirRule::kUnable);
  EXPECT_EQ(rule_for(at(0, 0, 0), at(1000, 0, 180), Standing::kOwnHigher, false),
            AirRule::kPreferred);
}

// Of two that converge at least one acts, whatever the geometry.
TEST(RightOfWay, SomebodyAlwaysActs) {
  RandomStream random(7, 1, Purpose::kTest);
  const auto climb = [&] { return random.uniform() < 0.3 ? random.uniform(-3, 3) : 0.0; };
  for (int k = 0; k < 20000; ++k) {
    const AirMotionState own =
        at(0, 0, random.uniform(0, 360), random.uniform(12, 28), climb());
    const AirMotionState other =
        at(random.uniform(-1000, 1000), random.uniform(-1000, 1000),
           random.uniform(0, 360), random.uniform(12, 28), climb());
    const Vec2 p = (other.p_N - own.p_N).head<2>(), v = (other.v_N - own.v_N).head<2>();
    if (p.dot(v) >= 0) continue;  // they part
    EXPECT_TRUE(acts(rule(own, other, true)) || acts(rule(other, own, false)))
        << k << ": " << name_of(rule(own, other, true)) << ", "
        << name_of(rule(other, own, false));
  }
}

}  // namespace
}  // namespace skein::reasoning::right_of_way_test
