// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/coverage/coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "skein/base/random.h"
#include "skein/solve/coverage/sweep_search.h"
#include "skein/solve/coverage/test/coverage_checks.h"
#include "skein/solve/path/test/plan_checks.h"

namespace skein::solve::coverage_test {
namespace {

const FlightLimits kLimits{15, 40, 3, 11, 20, 3};

CoverageQuery box(double north, double east) {
  CoverageQuery q;
  q.area = {{0, 0}, {north, 0}, {north, east}, {0, east}};
  q.swath = 60;
  q.limits = kLimits;
  q.aircraft[0].start = FlightState{{-200, -100, -100}, 0};
  return q;
}

TEST(Coverage, FliesOneLineOverAStrip) {
  CoverageQuery q = box(1000, 50);
  q.aircraft[0].start.reset();
  const CoverageResult r = plan_coverage(q);
  ASSERT_EQ(r.outcome, CoverageOutcome::kPlanned) << r.reason;
  EXPECT_EQ(r.lines, 1);
  EXPECT_NEAR(r.longest, 1000 / 15.0, 1e-3);
  EXPECT_NEAR(r.area, 50'000, 1);
  EXPECT_NEAR(r.covered_share, 1, 1e-9);
}

TEST(Coverage, StoppedItEndsWithTheBestSoFar) {
  CoverageQuery q = box(3000, 2000);
  const CoverageResult best = plan_coverage(q);
  EXPECT_FALSE(best.stopped);
  // Never asked before something is there, so even an early stop gives a plan.
  for (const int patience : {0, 1, 5, 400}) {
    int asked = 0;
    double reported = 0;
    q.watch.stop = [&] { return ++asked > patience; };
    q.watch.progress = [&](double share) {
      EXPECT_GE(share, reported);
      EXPECT_LE(share, 1);
      reported = share;
    };
    const CoverageResult r = plan_coverage(q);
    EXPECT_TRUE(r.stopped);
    ASSERT_EQ(r.outcome, CoverageOutcome::kPlanned) << r.reason;
    EXPECT_EQ(missed(q, r, 31), 0);
    EXPECT_GE(r.longest, best.longest - 1e-6);
    EXPECT_LT(asked, patience + 200);
  }
}

TEST(Coverage, KeepsTheGroundTrackInWind) {
  CoverageQuery q = box(900, 500);
  q.wind = {3, -6};
  q.bearing = 0.3;
  const CoverageResult r = plan_coverage(q);
  ASSERT_EQ(r.outcome, CoverageOutcome::kPlanned) << r.reason;
  expect_flyable(r.plans[0], q.limits, q.wind);
  int lines = 0;
  for (const FlightElement& e : r.plans[0]) {
    const model::FlightMoment m = model::end_of(e);
    const double off =
        std::remainder(geo::bearing(geo::horizontal(m.v_N)) - 0.3, geo::kPi);
    if (e.turn_rate == 0 && std::abs(off) < 1e-9) ++lines;
  }
  EXPECT_GE(lines, r.lines);
  EXPECT_EQ(missed(q, r, 10), 0);
}

TEST(Coverage, SeesEveryPointAndIsFlyable) {
  RandomStream random(7, 0, Purpose::kTest);
  for (int i = 0; i < 6; ++i) {
    CoverageQuery q;
    q.area = random_ring(random, 4 + i % 6, 0.1 + 0.06 * i);
    if (i % 2 == 1) q.holes = {{{-50, -60}, {80, -40}, {70, 90}, {-60, 40}}};
    q.swath = random.uniform(60, 160);
    q.overlap = i % 3 == 0 ? 0.2 : 0;
    q.overshoot = i % 4 == 0 ? 20 : 0;
    q.limits = kLimits;
    q.wind = random.uniform(0, 10) * geo::unit(random.uniform(0, 6.3));
    q.aircraft[0].start = FlightState{{random.uniform(-900, 900), 0, -80}, 2};
    if (i % 2 == 0) q.aircraft[0].end = q.aircraft[0].start;
    const CoverageResult r = plan_coverage(q);
    ASSERT_EQ(r.outcome, CoverageOutcome::kPlanned) << r.reason;
    expect_flyable(r.plans[0], q.limits, q.wind);
    EXPECT_EQ(missed(q, r, 11), 0) << "case " << i;
    EXPECT_NEAR(r.covered_share, 1, 1e-6) << "case " << i;
    EXPECT_NEAR(r.longest, model::duration(r.plans[0]), 1e-9);
  }
}

TEST(Coverage, SharesTheAreaEvenly) {
  RandomStream random(8, 0, Purpose::kTest);
  for (int i = 0; i < 2; ++i) {
    CoverageQuery q;
    q.area = random_ring(random, 4 + i % 4, 0.4);
    q.swath = 70;
    q.limits = kLimits;
    q.wind = random.uniform(0, 9) * geo::unit(random.uniform(0, 6.3));
    q.aircraft.assign(static_cast<std::size_t>(2 + i % 3), {FlightState{}, {}});
    for (CoverageAircraft& a : q.aircraft)
      a.start->p_N = {random.uniform(-800, 800), random.uniform(-800, 800), -100};
    const CoverageResult many = plan_coverage(q);
    ASSERT_EQ(many.outcome, CoverageOutcome::kPlanned) << many.reason;
    EXPECT_EQ(missed(q, many, 13), 0) << i;
    const auto count = static_cast<double>(q.aircraft.size());
    for (const FlightPlan& plan : many.plans) expect_flyable(plan, q.limits, q.wind);
    // Nobody is idle for long: a quarter of the time at most, on average.
    EXPECT_LT(many.longest, 1.25 * many.total / count) << i;
    q.aircraft.resize(1);
    EXPECT_LT(many.longest, plan_coverage(q).longest) << i;
  }
}

TEST(Coverage, CutsOneLineForTwo) {
  CoverageQuery q = box(3000, 50);
  q.aircraft = {{FlightState{{0, -50, -100}, 0}, {}},
                {FlightState{{1500, -50, -100}, 0}, {}}};
  const CoverageResult r = plan_coverage(q);
  ASSERT_EQ(r.outcome, CoverageOutcome::kPlanned);
  EXPECT_EQ(r.lines, 2);
  EXPECT_LT(r.longest, 1500 / 15.0 + 25);
}

TEST(Coverage, NamesWhatCannotBe) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto outcome = [](const auto& change) {
    CoverageQuery q = box(800, 500);
    change(q);
    const CoverageResult r = plan_coverage(q);
    EXPECT_FALSE(r.reason.empty());
    EXPECT_TRUE(r.plans.empty());
    return r.outcome;
  };
  using O = CoverageOutcome;
  EXPECT_EQ(outcome([](CoverageQuery& q) { q.area.resize(2); }), O::kBadArea);
  EXPECT_EQ(outcome([&](CoverageQuery& q) { q.area[1].x() = nan; }), O::kBadArea);
  EXPECT_EQ(outcome([](CoverageQuery& q) { q.area[2] = {0, 0}; }), O::kBadArea);
  EXPECT_EQ(outcome([](CoverageQuery& q) { q.area.assign(4, {5, 5}); }), O::kBadArea);
  EXPECT_EQ(outcome([](CoverageQuery& q) { q.swath = 0; }), O::kBadSwath);
  EXPECT_EQ(outcome([](CoverageQuery& q) { q.overlap = 1; }), O::kBadSwath);
  EXPECT_EQ(outcome([&](CoverageQuery& q) { q.bearing = nan; }), O::kBadSwath);
  EXPECT_EQ(outcome([](CoverageQuery& q) { q.swath = 0.1; }), O::kTooManyLines);
  EXPECT_EQ(outcome([](CoverageQuery& q) { q.wind = {15, 0}; }), O::kWindTooStrong);
  EXPECT_EQ(outcome([](CoverageQuery& q) { q.aircraft.clear(); }), O::kBadAircraft);
  EXPECT_EQ(outcome([](CoverageQuery& q) { q.limits.airspeed = -1; }), O::kBadAircraft);
  EXPECT_EQ(outcome([&](CoverageQuery& q) { q.aircraft[0].start->heading = nan; }),
            O::kBadAircraft);
  EXPECT_EQ(outcome([](CoverageQuery& q) { q.holes = {q.area}; }), O::kNothingToCover);
  EXPECT_EQ(outcome([](CoverageQuery& q) {
              q.zones = {{Disc{{0, 0}, 0}}};
            }),
            O::kBadZone);
  EXPECT_EQ(outcome([](CoverageQuery& q) {
              q.zones = {{geo::Ring{{0, 0}, {0, 100}, {100, 0}}}};
            }),
            O::kBadZone);
  EXPECT_EQ(outcome([](CoverageQuery& q) {
              q.zones = {{Disc{{400, 250}, 600}}};
            }),
            O::kNothingToCover);
}

TEST(Coverage, OffersACrossingAreaWithoutItsCrossing) {
  CoverageQuery q = box(800, 500);
  std::swap(q.area[1], q.area[2]);
  const CoverageResult r = plan_coverage(q);
  EXPECT_EQ(r.outcome, CoverageOutcome::kBadArea);
  ASSERT_TRUE(r.alternative.has_value());
  EXPECT_EQ(r.alternative->size(), 2u);
  EXPECT_NEAR(geo::area(*r.alternative), 200'000, 1);
}

SweepTask random_task(RandomStream& random, int i) {
  SweepTask task;
  geo::Ring ring = random_ring(random, 3 + i % 5, i % 2 == 0 ? 0.2 : 0.6);
  task.area = {ring};
  task.spacing = random.uniform(80, 200);
  task.joined = 50;
  task.air = {15, random.uniform(30, 80),
              random.uniform(0, 11) * geo::unit(random.uniform(0, 6.3))};
  task.ends = {{model::Pose{{random.uniform(-900, 900), -800}, 1}, std::nullopt}};
  return task;
}

// The quickest of all orders and directions, one after the other.
double tried_out(LineCosts& costs, std::vector<int>& left, int here, double so_far,
                 double best) {
  if (so_far >= best) return best;
  if (left.empty()) return std::min(best, so_far + costs.cost(here, costs.end_of(0)));
  for (std::size_t k = 0; k < left.size(); ++k) {
    const int line = left[k];
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
    for (const int visit : {2 * line, 2 * line + 1})
      best = tried_out(costs, left, visit, so_far + costs.cost(here, visit), best);
    left.insert(left.begin() + static_cast<std::ptrdiff_t>(k), line);
  }
  return best;
}

TEST(LineOrder, SetsAndStepsFindWhatTryingOutFinds) {
  RandomStream random(3, 0, Purpose::kTest);
  double max = 0;
  for (int i = 0; i < 40; ++i) {
    const SweepTask task = random_task(random, i);
    std::vector<SweepLine> lines =
        lines_at(task, random.uniform(0, geo::kPi), CellRule::kCommonLines);
    if (lines.size() > 7) lines.resize(7);
    LineCosts costs(lines, task.air, task.ends);
    std::vector<int> left(lines.size());
    std::iota(left.begin(), left.end(), 0);
    const double best = tried_out(costs, left, costs.start_of(0), 0, 1e300);
    const Route pattern = quickest_pattern(costs, 0, 6);
    EXPECT_NEAR(route_time(costs, 0, quickest_order(costs, 0, pattern)), best, 1e-9);
    const double steps = route_time(costs, 0, improved(costs, 0, pattern, 20));
    EXPECT_GE(steps, best - 1e-9);
    max = std::max(max, steps / best - 1);
  }
  EXPECT_LT(max, 0.01);  // steps and kicks usually find the best of so few lines
}

TEST(Coverage, IsWithinThreePerCentOfAllBearings) {
  RandomStream random(11, 0, Purpose::kTest);
  for (int i = 0; i < 6; ++i) {
    const SweepTask task = random_task(random, i);
    const double found = best_sweep(task).longest;
    double best = 1e300;
    for (int k = 0; k < 720; ++k)
      best = std::min(best, sweep_at(task, k * geo::kPi / 720, {}).longest);
    EXPECT_LT(found, 1.03 * best) << "case " << i;
  }
}

}  // namespace
}  // namespace skein::solve::coverage_test
