#include "skein/layer/reasoning/avoidance/meeting/flight_envelope.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "skein/layer/reasoning/avoidance/meeting/plan_meeting.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

const Separation kApart{50, 20};

double number(double low, double high) {
  return low + *rc::gen::inRange(0, 1000) / 999.0 * (high - low);
}

// Straights, turns, climbs and vertical turns in wind, within some kilometres.
FlightPlan any_plan() {
  FlightPlan plan;
  FlightElement e;
  e.start = number(0, 30);
  e.p_N = {number(-1000, 1000), number(-1000, 1000), number(-180, -90)};
  e.heading = number(-3, 3);
  e.wind = {number(-8, 8), number(-8, 8)};
  for (int k = 0; k < 5; ++k) {
    e.airspeed = number(12, 25);
    e.duration = number(0.5, 30);
    e.turn_rate = *rc::gen::inRange(0, 2) == 0 ? 0 : number(-0.4, 0.4);
    e.climb_rate = number(-3, 3);
    e.climb_acceleration = *rc::gen::inRange(0, 3) == 0 ? number(-0.5, 0.5) : 0;
    plan.push_back(e);
    const model::FlightMoment end = model::end_of(e);
    e.p_N = end.p_N;
    e.heading = end.heading;
    e.start += e.duration;
  }
  return plan;
}

FlightPlan straight(const Vec3& from, double heading) {
  FlightElement e;
  e.duration = 200;
  e.airspeed = 20;
  e.heading = heading;
  e.p_N = from;
  return {e};
}

RC_GTEST_PROP(FlightEnvelope, RulesOutNobodyWhoMeetsAFlight, ()) {
  const double from = number(0, 40), until = from + number(1, 150);
  FlightEnvelope envelope(from, until);
  std::vector<FlightPlan> flights;
  for (int k = *rc::gen::inRange(1, 4); k > 0; --k) flights.push_back(any_plan());
  for (const FlightPlan& each : flights) envelope.add(each);
  const FlightPlan other = any_plan();
  const bool meets = std::ranges::any_of(flights, [&](const FlightPlan& each) {
    return first_meeting(each, other, kApart, from, until).has_value();
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
}  // namespace skein::reasoning
