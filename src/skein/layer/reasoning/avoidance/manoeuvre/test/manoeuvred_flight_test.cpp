// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/manoeuvre/manoeuvred_flight.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "skein/layer/reasoning/avoidance/encounter/plan_encounter.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/link.h"

namespace skein::reasoning::manoeuvred_flight_test {
namespace {

double number(double low, double high) {
  return low + *rc::gen::inRange(0, 1000) / 999.0 * (high - low);
}

FlightLimits any_limits() {
  FlightLimits limits;
  limits.airspeed = number(15, 25);
  limits.turn_radius = number(40, 90);
  limits.slowest = 0.75 * limits.airspeed;
  limits.fastest = 1.25 * limits.airspeed;
  limits.climb_acceleration = *rc::gen::inRange(0, 2) == 0 ? 0 : 0.7;
  return limits;
}

FlightPlan any_plan(const FlightLimits& limits) {
  PathQuery query;
  query.limits = limits;
  query.wind = {number(-7, 7), number(-7, 7)};
  query.start = {{0, 0, -150}, number(-3, 3)};
  query.goal = {{number(-4000, 4000), number(3000, 4000), number(-200, -100)},
                number(-3, 3)};
  const double start = number(0, 50);
  return solve::to_flight_plan(solve::link(query.start, query.goal, query), query.start,
                               start, query);
}

// The elements join and stay within what the aircraft can do.
void expect_flyable(const FlightPlan& plan, const FlightLimits& limits) {
  for (std::size_t k = 0; k < plan.size(); ++k) {
    const FlightElement& e = plan[k];
    RC_ASSERT(e.airspeed >= limits.slowest - 1e-9 && e.airspeed <= limits.fastest + 1e-9);
    // The same bank at any airspeed.
    const double factor = e.airspeed / limits.airspeed;
    const double radius = limits.turn_radius * factor * factor;
    RC_ASSERT(std::abs(e.turn_rate) * radius <= e.airspeed * (1 + 1e-9));
    const model::FlightMoment end = model::end_of(e);
    for (const double climb : {e.climb_rate, -end.v_N.z()})
      RC_ASSERT(climb <= limits.climb_rate + 1e-6 && climb >= -limits.sink_rate - 1e-6);
    if (k + 1 == plan.size()) break;
    RC_ASSERT(std::abs(plan[k + 1].start - e.start - e.duration) < 1e-6);
    RC_ASSERT((plan[k + 1].p_N - end.p_N).norm() < 1e-3);
    RC_ASSERT(std::abs(geo::wrap_pi(plan[k + 1].heading - end.heading)) < 1e-6);
  }
}

RC_GTEST_PROP(ManoeuvredFlight, IsFlyableAndEndsWhereThePlanDoes, ()) {
  const FlightLimits limits = any_limits();
  const FlightPlan plan = any_plan(limits);
  const double begin = model::start_of(plan) + number(0, 20);
  const double meets = begin + number(5, 100);
  const ConflictOfFlight conflict{
      plan, limits, begin, meets, meets + number(0, 5), meets + number(5, 10), {50, 20}};
  const FlightState goal = solve::state_after(plan);
  int made = 0;
  for (const Manoeuvre& manoeuvre : manoeuvres(limits, {50, 20}, number(1, 3))) {
    const auto flight = manoeuvred(manoeuvre, conflict);
    if (!flight) continue;
    ++made;
    RC_ASSERT(std::abs(model::start_of(*flight) - begin) < 1e-9);
    RC_ASSERT((flight->front().p_N - model::moment_at(plan, begin).p_N).norm() < 1e-6);
    RC_ASSERT((solve::state_after(*flight).p_N - goal.p_N).norm() < 0.01);
    expect_flyable(*flight, limits);
  }
  RC_ASSERT(made >= 2);
}

TEST(ManoeuvredFlight, PassesWhereItIsSaid) {
  FlightLimits limits;
  FlightElement straight;
  straight.duration = 200;
  straight.airspeed = limits.airspeed;
  const FlightPlan plan{straight};
  const ConflictOfFlight conflict{plan, limits, 10, 60, 62, 64, {50, 20}};
  const auto at = [&](const Manoeuvre& m, double time) {
    return model::moment_at(manoeuvred(m, conflict).value(), time).p_N;
  };
  // Beside the place of the conflict, a little later than it would have been there.
  EXPECT_NEAR(at({ManoeuvreKind::kRight, 100, 25}, 62.5).y(), 100, 3);
  EXPECT_NEAR(at({ManoeuvreKind::kLeft, 100, 25}, 62.5).y(), -100, 3);
  EXPECT_NEAR(at({ManoeuvreKind::kRight, 100, 25}, 34).y(), 0, 1e-6) << "not left yet";
  EXPECT_NEAR(at({ManoeuvreKind::kUp, 44}, 60).z(), -44, 1e-6);
  EXPECT_NEAR(at({ManoeuvreKind::kUp, 44}, 65).z(), -44, 1e-6);
  EXPECT_NEAR(at({ManoeuvreKind::kDown, 44}, 60).z(), 44, 1e-6);
  EXPECT_NEAR(at({ManoeuvreKind::kSpeed, 0.88}, 60).x(), 200 + 50 * 17.6, 1e-6);
  EXPECT_NEAR(at({ManoeuvreKind::kDirect}, 60).x(), 1200, 1e-6);
  // No time is left for it.
  EXPECT_FALSE(manoeuvred({ManoeuvreKind::kUp, 300}, conflict));
  EXPECT_FALSE(
      manoeuvred({ManoeuvreKind::kGoOn}, {plan, limits, 300, 310, 311, 312, {50, 20}}));
}

// What one does leaves the other's plan free: two that meet head-on always find
// something.
RC_GTEST_PROP(ManoeuvredFlight, OfOneOrTheOtherSolvesAMeeting, ()) {
  const FlightLimits limits = any_limits();
  const Separation apart{50, 20};
  FlightElement one, other;
  one.airspeed = other.airspeed = limits.airspeed;
  one.duration = other.duration = 4000 / limits.airspeed;
  other.heading = number(0.5, 5.8);
  // They meet after half of the time, or nearly.
  other.p_N.head<2>() = Vec2(2000, number(-40, 40)) - 2000 * geo::unit(other.heading);
  other.p_N.z() = number(-15, 15);
  const FlightPlan a{one}, b{other};
  const double end = one.duration;
  const auto encounter = first_encounter(a, b, apart, 0, end);
  RC_PRE(encounter.has_value());
  const ConflictOfFlight of_a{a,
                              limits,
                              encounter->begin - 45,
                              encounter->begin,
                              encounter->closest_time,
                              encounter->end,
                              apart};
  int free = 0;
  for (const Manoeuvre& m : manoeuvres(limits, apart, 1)) {
    const auto flight = manoeuvred(m, of_a);
    if (flight && !first_encounter(*flight, b, apart, 0, end)) ++free;
  }
  RC_ASSERT(free > 0);
}

}  // namespace
}  // namespace skein::reasoning::manoeuvred_flight_test
