// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/encounter/flight_envelope.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "skein/layer/reasoning/avoidance/encounter/plan_encounter.h"
#include "skein/layer/reasoning/avoidance/encounter/test/any_plan.h"
#include "skein/layer/reasoning/avoidance/encounter/test/straight_flight.h"

namespace skein::reasoning::flight_envelope_test {
namespace {

const Separation kApart{50, 20};
constexpr AnyPlan kKilometres{30, 1000, 90, 180, 30};

RC_GTEST_PROP(FlightEnvelope, RulesOutNobodyWhoMeetsAFlight, ()) {
  const double from = number(0, 40), until = from + number(1, 150);
  FlightEnvelope envelope(from, until);
  std::vector<FlightPlan> flights;
  for (int k = *rc::gen::inRange(1, 4); k > 0; --k)
    flights.push_back(any_plan(kKilometres));
  for (const FlightPlan& each : flights) envelope.add(each);
  const FlightPlan other = any_plan(kKilometres);
  const bool meets = std::ranges::any_of(flights, [&](const FlightPlan& each) {
    return first_encounter(each, other, kApart, from, until).has_value();
  });
  RC_CLASSIFY(meets, "meet");
  RC_CLASSIFY(!envelope.may_meet(other, kApart), "ruled out");
  if (meets) RC_ASSERT(envelope.may_meet(other, kApart));
}

TEST(FlightEnvelope, RulesOutWhoPassesTheSamePlaceAtAnotherTime) {
  FlightEnvelope envelope(0, 200);
  envelope.add(straight(Vec3(0, 0, -100), 0));
  // Both are 2 km north after 100 s.
  EXPECT_TRUE(envelope.may_meet(straight(Vec3(2000, 2000, -100), -geo::kPi / 2), kApart));
  // Half a minute later.
  EXPECT_FALSE(
      envelope.may_meet(straight(Vec3(2000, 2600, -100), -geo::kPi / 2), kApart));
}

TEST(FlightEnvelope, RulesOutWhoPassesAbove) {
  FlightEnvelope envelope(0, 200);
  envelope.add(straight(Vec3(0, 0, -100), 0));
  EXPECT_FALSE(
      envelope.may_meet(straight(Vec3(2000, 2000, -125), -geo::kPi / 2), kApart));
}

TEST(FlightEnvelope, OfNoFlightsRulesOutAll) {
  const FlightEnvelope envelope(0, 200);
  EXPECT_FALSE(envelope.may_meet(straight(Vec3(0, 0, -100), 0), kApart));
}

TEST(FlightEnvelope, OnlyTheTimeInBothCounts) {
  FlightEnvelope envelope(0, 50);
  envelope.add(straight(Vec3(0, 0, -100), 0));
  EXPECT_FALSE(
      envelope.may_meet(straight(Vec3(2000, 2000, -100), -geo::kPi / 2), kApart));
  EXPECT_FALSE(envelope.may_meet({}, kApart));
}

}  // namespace
}  // namespace skein::reasoning::flight_envelope_test
