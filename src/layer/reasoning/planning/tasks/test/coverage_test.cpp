#include "layer/reasoning/planning/tasks/coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/random.h"
#include "layer/reasoning/planning/tasks/sweep_search.h"
#include "layer/reasoning/planning/tasks/test/plan_checks.h"

namespace skein::planning {
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

// A star-shaped ring of random corners.
geo::Ring random_ring(RandomStream& random, int corners, double ragged) {
  geo::Ring ring;
  const Vec2 centre(random.uniform(-300, 300), random.uniform(-300, 300));
  for (int i = 0; i < corners; ++i)
    ring.push_back(centre +
                   random.uniform(600 * (1 - ragged), 600) *
                       geo::unit(2 * geo::kPi * (i + 0.5 * random.uniform()) / corners));
  return ring;
}

bool beside_a_line(const std::vector<FlightPlan>& plans, const Vec2& p, double half) {
  for (const FlightPlan& plan : plans)
    for (const FlightElement& e : plan) {
      if (e.turn_rate != 0) continue;
      const Vec2 a = geo::horizontal(e.p_N);
      const Vec2 way = geo::horizontal(model::end_of(e).p_N) - a;
      const double length = way.norm();
      if (length <= 0) continue;
      const double along = way.dot(p - a) / length;
      if (along < -1e-3 || along > length + 1e-3) continue;
      if (std::abs(geo::cross(way, p - a)) <= half * length) return true;
    }
  return false;
}

bool inside_area(const CoverageQuery& q, const Vec2& p) {
  if (!geo::contains(q.area, p)) return false;
  for (const geo::Ring& hole : q.holes)
    if (geo::contains(hole, p)) return false;
  return std::none_of(q.zones.begin(), q.zones.end(),
                      [&](const Zone& z) { return covers(z, p); });
}

// Points of a grid over the area that no straight of a plan sees.
int missed(const CoverageQuery& q, const CoverageResult& r, double step) {
  int count = 0;
  for (double x = -1000; x <= 1600; x += step)
    for (double y = -1000; y <= 1600; y += step)
      if (inside_area(q, {x, y}) && !beside_a_line(r.plans, {x, y}, q.swath / 2 + 1e-3))
        ++count;
  return count;
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
  for (int i = 0; i < 12; ++i) {
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
  double most = 0;
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
    most = std::max(most, steps / best - 1);
  }
  EXPECT_LT(most, 0.01);  // steps and kicks usually find the best of so few lines
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
}  // namespace skein::planning
