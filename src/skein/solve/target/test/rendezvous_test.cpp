// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/target/rendezvous.h"

#include <gtest/gtest.h>

#include <limits>

#include "skein/base/random.h"
#include "skein/solve/path/test/plan_checks.h"
#include "skein/solve/target/timed_flight.h"

namespace skein::solve::rendezvous_test {
namespace {

const FlightLimits kLimits{15, 40, 3, 11, 20, 3};

FlightState random_state(RandomStream& random, double box) {
  return {
      {random.uniform(-box, box), random.uniform(-box, box), -random.uniform(80, 120)},
      random.uniform(-3, 3)};
}

void expect_there(const FlightPlan& plan, const FlightState& goal, double time) {
  ASSERT_FALSE(plan.empty());
  const model::FlightMoment end = model::end_of(plan.back());
  EXPECT_NEAR(model::end_time_of(plan), time, 1e-6);
  EXPECT_LT((end.p_N - goal.p_N).norm(), 1e-5);
  EXPECT_NEAR(geo::wrap_pi(end.heading - goal.heading), 0, 1e-8);
}

TEST(Rendezvous, AllArriveAtOnce) {
  RandomStream random(21, 0, Purpose::kTest);
  for (int i = 0; i < 60; ++i) {
    RendezvousQuery q;
    q.wind = random.uniform(0, 9) * geo::unit(random.uniform(0, 6.3));
    q.any_airspeed = i % 3 != 0;
    for (int k = 0; k < 4; ++k)
      q.aircraft.push_back({random_state(random, 2000), random_state(random, 300),
                            random.uniform(0, 60), kLimits});
    const RendezvousResult r = plan_rendezvous(q);
    ASSERT_EQ(r.outcome, RendezvousOutcome::kPlanned) << r.reason;
    for (std::size_t k = 0; k < 4; ++k) {
      expect_flyable(r.plans[k], kLimits, q.wind);
      EXPECT_EQ(r.plans[k].front().p_N, q.aircraft[k].start.p_N);
      EXPECT_NEAR(r.plans[k].front().start, q.aircraft[k].start_time, 1e-9);
      expect_there(r.plans[k], q.aircraft[k].goal, r.earliest);
      EXPECT_GE(r.airspeeds[k], kLimits.slowest - 1e-9);
      EXPECT_LE(r.airspeeds[k], kLimits.fastest + 1e-9);
    }
  }
}

TEST(Rendezvous, ArrivesInASequence) {
  RandomStream random(22, 0, Purpose::kTest);
  RendezvousQuery q;
  q.wind = {3, 4};
  q.spacing = 20;
  for (int k = 0; k < 5; ++k)
    q.aircraft.push_back(
        {random_state(random, 2000), {{0, 0, -100}, 1}, 10.0 * k, kLimits});
  const RendezvousResult r = plan_rendezvous(q);
  ASSERT_EQ(r.outcome, RendezvousOutcome::kPlanned) << r.reason;
  std::vector<double> times = r.arrivals;
  std::sort(times.begin(), times.end());
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(times[k], r.earliest + 20 * static_cast<double>(k), 1e-9);
    expect_there(r.plans[k], q.aircraft[k].goal, r.arrivals[k]);
  }
}

TEST(Rendezvous, UsesAirspeedBeforeDetours) {
  RendezvousQuery q;
  q.aircraft = {{{{0, 0, -100}, 0}, {{1500, 0, -100}, 0}, 0, kLimits}};
  q.time = 120;  // 12.5 m/s straight on
  const RendezvousResult r = plan_rendezvous(q);
  ASSERT_EQ(r.outcome, RendezvousOutcome::kPlanned) << r.reason;
  EXPECT_EQ(r.plans[0].size(), 1u);
  EXPECT_NEAR(r.airspeeds[0], 12.5, 1e-6);
  EXPECT_NEAR(r.earliest, 75, 1e-6);
  q.time = 300;
  const RendezvousResult later = plan_rendezvous(q);
  ASSERT_EQ(later.outcome, RendezvousOutcome::kPlanned) << later.reason;
  EXPECT_EQ(later.airspeeds[0], 11);
  EXPECT_GT(later.plans[0].size(), 1u);
  expect_there(later.plans[0], q.aircraft[0].goal, 300);
}

TEST(Rendezvous, SaysTheEarliestTime) {
  RendezvousQuery q;
  q.aircraft = {{{{0, 0, -100}, 0}, {{1500, 0, -100}, 0}, 0, kLimits}};
  q.time = 60;
  RendezvousResult r = plan_rendezvous(q);
  EXPECT_EQ(r.outcome, RendezvousOutcome::kTooEarly);
  EXPECT_NEAR(r.earliest, 75, 1e-6);
  EXPECT_TRUE(r.plans.empty());
  q.time = r.earliest;
  EXPECT_EQ(plan_rendezvous(q).outcome, RendezvousOutcome::kPlanned);
  // A climb takes longer than the path.
  q.aircraft[0].goal.p_N.z() = -400;
  r = plan_rendezvous(q);
  EXPECT_EQ(r.outcome, RendezvousOutcome::kTooEarly);
  EXPECT_NEAR(r.earliest, 100, 1e-9);
  q.time = r.earliest;
  r = plan_rendezvous(q);
  ASSERT_EQ(r.outcome, RendezvousOutcome::kPlanned) << r.reason;
  expect_there(r.plans[0], q.aircraft[0].goal, 100);
}

TEST(TimedFlight, MeetsAllTimesBeyondTwoCirclesMore) {
  RandomStream random(23, 0, Purpose::kTest);
  int gaps = 0;
  for (int i = 0; i < 200; ++i) {
    FlightLimits limits = kLimits;
    limits.climb_acceleration = i % 3;
    const TimedLeg leg{random_state(random, i % 2 == 0 ? 150 : 1000),
                       random_state(random, 150),
                       random.uniform(0, 10),
                       limits,
                       random.uniform(0, 10) * geo::unit(random.uniform(0, 6.3)),
                       i % 4 < 2};
    const double earliest = earliest_arrival(leg);
    const double time = earliest + random.uniform(0, 200);
    const TimedFlight f = arrive_at(leg, time);
    const double circles = 4 * geo::kPi * 40 / 15;
    if (time > earliest + circles) {
      ASSERT_EQ(f.status, TimedStatus::kFound) << i;
    }
    if (f.status == TimedStatus::kFound) {
      expect_flyable(f.plan, limits, leg.wind);
      expect_there(f.plan, leg.to, time);
      continue;
    }
    ++gaps;
    EXPECT_EQ(f.status, TimedStatus::kGap);
    EXPECT_EQ(arrive_at(leg, f.next).status, TimedStatus::kFound) << i;
  }
  EXPECT_LT(gaps, 40);
}

TEST(Rendezvous, NamesWhatCannotBe) {
  const auto outcome = [](const auto& change) {
    RendezvousQuery q;
    q.aircraft = {{{{0, 0, -100}, 0}, {{1500, 0, -100}, 0}, 0, kLimits}};
    change(q);
    const RendezvousResult r = plan_rendezvous(q);
    EXPECT_FALSE(r.reason.empty());
    return r.outcome;
  };
  using O = RendezvousOutcome;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(outcome([](RendezvousQuery& q) { q.aircraft.clear(); }), O::kBadQuery);
  EXPECT_EQ(outcome([&](RendezvousQuery& q) { q.spacing = nan; }), O::kBadQuery);
  EXPECT_EQ(outcome([](RendezvousQuery& q) { q.spacing = -1; }), O::kBadQuery);
  EXPECT_EQ(outcome([&](RendezvousQuery& q) { q.time = nan; }), O::kBadQuery);
  EXPECT_EQ(outcome([&](RendezvousQuery& q) { q.aircraft[0].goal.heading = nan; }),
            O::kBadAircraft);
  EXPECT_EQ(outcome([](RendezvousQuery& q) { q.aircraft[0].limits.airspeed = 0; }),
            O::kBadAircraft);
  EXPECT_EQ(outcome([](RendezvousQuery& q) { q.aircraft[0].limits.slowest = 17; }),
            O::kBadAircraft);
  EXPECT_EQ(outcome([](RendezvousQuery& q) { q.wind = {30, 0}; }), O::kWindTooStrong);
}

}  // namespace
}  // namespace skein::solve::rendezvous_test
