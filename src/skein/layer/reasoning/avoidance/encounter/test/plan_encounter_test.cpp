// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/encounter/plan_encounter.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "skein/layer/reasoning/avoidance/encounter/test/any_plan.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning::plan_encounter_test {
namespace {

const Separation kApart{50, 20};
constexpr AnyPlan kNear{10, 400, 90, 130, 15};

double ratio_at(const FlightPlan& a, const FlightPlan& b, double time) {
  const Vec3 apart = model::moment_at(a, time).p_N - model::moment_at(b, time).p_N;
  return kApart.ratio(apart.head<2>().norm(), std::abs(apart.z()));
}

// 6 cm of 20 m.
constexpr double kExactness = 0.06 / 20;

RC_GTEST_PROP(PlanEncounter, IsWhereSamplesOfBothFlightsAreNear, ()) {
  const FlightPlan a = any_plan(kNear), b = any_plan(kNear);
  const double from = number(0, 20), until = from + number(5, 60);
  const auto encounter = first_encounter(a, b, kApart, from, until);
  const double begin = std::max({from, model::start_of(a), model::start_of(b)});
  const double end = std::min({until, model::end_time_of(a), model::end_time_of(b)});
  RC_CLASSIFY(encounter.has_value(), "meet");
  double least = 10;
  for (double t = begin; t <= end; t += 0.02) {
    const double ratio = ratio_at(a, b, t);
    const bool before = !encounter || t < encounter->begin;
    if (before) RC_ASSERT(ratio >= 1 - kExactness);
    if (encounter && t > encounter->begin && t < encounter->end) {
      RC_ASSERT(ratio <= 1 + kExactness);
      least = std::min(least, ratio);
    }
  }
  if (!encounter) return;
  RC_ASSERT(encounter->begin >= begin && encounter->end <= end + 1e-9);
  RC_ASSERT(encounter->closest_time >= encounter->begin - 1e-9);
  RC_ASSERT(encounter->closest_time <= encounter->end + 1e-9);
  RC_ASSERT(std::abs(ratio_at(a, b, encounter->closest_time) - encounter->min_ratio) <
            kExactness);
  if (encounter->end - encounter->begin > 0.05)
    RC_ASSERT(least >= encounter->min_ratio - kExactness);
}

RC_GTEST_PROP(PlanEncounter, IsTheSameForBoth, ()) {
  const FlightPlan a = any_plan(kNear), b = any_plan(kNear);
  const auto one = first_encounter(a, b, kApart, 0, 100);
  const auto other = first_encounter(b, a, kApart, 0, 100);
  RC_ASSERT(one.has_value() == other.has_value());
  if (!one) return;
  RC_ASSERT(one->begin == other->begin && one->end == other->end);
  RC_ASSERT(one->min_ratio == other->min_ratio);
}

TEST(PlanEncounter, OfTwoHeadOnIsWhenTheySay) {
  FlightElement north, south;
  north.duration = south.duration = 100;
  north.airspeed = south.airspeed = 20;
  south.p_N = {2000, 0, 0};
  south.heading = geo::kPi;
  const auto encounter = first_encounter({north}, {south}, kApart, 0, 90);
  ASSERT_TRUE(encounter);
  EXPECT_NEAR(encounter->begin, 1950 / 40.0, 1e-9);
  EXPECT_NEAR(encounter->end, 2050 / 40.0, 1e-9);
  EXPECT_NEAR(encounter->min_ratio, 0, 1e-9);
  EXPECT_NEAR(encounter->closest_time, 50, 1e-9);
  south.p_N.z() = -25;
  EXPECT_FALSE(first_encounter({north}, {south}, kApart, 0, 90));
  EXPECT_FALSE(first_encounter({north}, {}, kApart, 0, 90));
}

TEST(PlanEncounter, IsTheFirstOfSeveralAndEndsWhereTheLookEnds) {
  // One flies straight, the other crosses its path, turns around and crosses it again.
  FlightElement straight;
  straight.duration = 200;
  straight.airspeed = 0.1;
  FlightPlan weaving;
  FlightElement e;
  e.p_N = {0, -500, 0};
  e.heading = geo::kPi / 2;
  e.airspeed = 20;
  e.duration = 50;
  weaving.push_back(e);
  e.p_N = model::end_of(e).p_N;
  e.start = 50;
  e.heading = -geo::kPi / 2;
  weaving.push_back(e);
  const auto first = first_encounter({straight}, weaving, kApart, 0, 200);
  ASSERT_TRUE(first);
  EXPECT_LT(first->end, 29);
  const auto second = first_encounter({straight}, weaving, kApart, 30, 75);
  ASSERT_TRUE(second);
  EXPECT_GT(second->begin, 70);
  EXPECT_EQ(second->end, 75);
}

}  // namespace
}  // namespace skein::reasoning::plan_encounter_test
