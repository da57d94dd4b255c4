// SPDX-License-Identifier: Apache-2.0
// Planners for tasks: what a survey costs to plan, and how far it is from the best sweep
// of all bearings in steps of 0.25 degrees.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "skein/base/random.h"
#include "skein/geo/clip.h"
#include "skein/model/path/wind_triangle.h"
#include "skein/solve/coverage/coverage.h"
#include "skein/solve/coverage/sweep_search.h"
#include "skein/solve/path/aa_star.h"

namespace skein::solve {
namespace {

const FlightLimits kLimits{15, 40, 3, 11, 20, 3};

// A star-shaped ring of random corners, about `radius` around the origin.
geo::Ring ring_of(RandomStream& random, int corners, double radius, double ragged) {
  geo::Ring ring;
  for (int i = 0; i < corners; ++i)
    ring.push_back(random.uniform(radius * (1 - ragged), radius) *
                   geo::unit(2 * geo::kPi * (i + 0.7 * random.uniform()) / corners));
  return ring;
}

// Case i of a series: shapes from triangles to ragged stars, some with a hole, turn radii
// from half to two thirds of twice the spacing, wind up to 0.8 of the airspeed.
SweepTask task_of(std::uint64_t i, int aircraft) {
  RandomStream random(i, 0, Purpose::kTest);
  SweepTask task;
  task.area = {ring_of(random, 3 + static_cast<int>(i % 6), 700, i % 2 == 0 ? 0.3 : 0.7)};
  if (i % 3 == 2) {
    geo::Ring hole = ring_of(random, 5, 120, 0.4);
    std::reverse(hole.begin(), hole.end());
    task.area.push_back(hole);
  }
  task.spacing = random.uniform(60, 200);
  const double radius = random.uniform(0.25, 1.5) * task.spacing;
  task.air = {15, radius, random.uniform(0, 12) * geo::unit(random.uniform(0, 6.3))};
  task.joined = radius;
  for (int k = 0; k < aircraft; ++k)
    task.ends.push_back(
        {model::Pose{{random.uniform(-900, 900), -900}, random.uniform(0, 6)},
         std::nullopt});
  return task;
}

double best_of_all(const SweepTask& task) {
  double best = 1e300;
  for (int k = 0; k < 720; ++k)
    best = std::min(best, sweep_at(task, k * geo::kPi / 720, {}).cost);
  return best;
}

// One to three discs in and about the area of case i.
std::vector<Zone> zones_of(std::uint64_t i) {
  RandomStream random(i, 1, Purpose::kTest);
  std::vector<Zone> zones;
  for (std::uint64_t k = 0; k <= i % 3; ++k)
    zones.push_back({Disc{random.uniform(0, 500) * geo::unit(random.uniform(0, 6.3)),
                          random.uniform(30, 120)}});
  return zones;
}

// The same with some of the area not to be flown over.
SweepTask with_zones(std::uint64_t i, SweepTask task) {
  std::vector<geo::Ring> rings;
  for (const Zone& zone : zones_of(i)) rings.push_back(outline(zone));
  task.area = geo::subtract(task.area, rings);
  task.zones = ZoneRings(std::move(rings));
  task.room = {0.01, model::ground_turn_radius(task.air.turn_radius, task.air.airspeed,
                                               task.air.wind.norm())};
  return task;
}

// How much longer than the best of 720 bearings, with the same orders: worst and mean.
void sweep_gap(benchmark::State& state) {
  const auto aircraft = static_cast<int>(state.range(0));
  double worst = -1, mean = 0, over = 0;
  const auto cases = static_cast<std::uint64_t>(state.range(1));
  for (auto _ : state) {
    for (std::uint64_t i = 0; i < cases; ++i) {
      SweepTask task = task_of(i, aircraft);
      if (state.range(2) > 0) task = with_zones(i, task);
      const double gap = best_sweep(task).cost / best_of_all(task) - 1;
      worst = std::max(worst, gap);
      mean += gap / static_cast<double>(cases);
      over += gap > 0.03 ? 1 : 0;
    }
  }
  state.counters["worst_%"] = 100 * worst;
  state.counters["mean_%"] = 100 * mean;
  state.counters["above_3%"] = over;
}
BENCHMARK(sweep_gap)
    ->ArgNames({"aircraft", "cases", "zones"})
    ->Args({1, 200, 0})
    ->Args({3, 34, 0})
    ->Args({1, 40, 1})
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

// How much is seen of areas with zones, and how long connections lie in these.
void around_zones(benchmark::State& state) {
  const AaStar planner;
  double min = 1, mean = 0, whole = 0, entered = 0;
  const auto cases = static_cast<std::uint64_t>(state.range(0));
  for (auto _ : state)
    for (std::uint64_t i = 0; i < cases; ++i) {
      const SweepTask task = task_of(i, 1);
      CoverageQuery q;
      q.area = task.area[0];
      q.zones = zones_of(i);
      q.swath = task.spacing;
      q.limits = kLimits;
      q.limits.turn_radius = task.air.turn_radius;
      q.wind = task.air.wind;
      q.aircraft[0].start = FlightState{{-1500, 0, -100}, 0};
      q.planner = &planner;
      const CoverageResult r = plan_coverage(q);
      min = std::min(min, r.covered_share);
      mean += r.covered_share / static_cast<double>(cases);
      whole += r.covered_share > 0.9995 ? 1 : 0;
      entered += r.in_zones > 0 ? 1 : 0;
    }
  state.counters["least_%"] = 100 * min;
  state.counters["mean_%"] = 100 * mean;
  state.counters["above_99.95_%"] = whole;
  state.counters["in_zones"] = entered;
}
BENCHMARK(around_zones)->Arg(200)->Iterations(1)->Unit(benchmark::kSecond);

// How much longer than the best order, of up to 11 lines.
void order_gap(benchmark::State& state) {
  double worst = 0, mean = 0, count = 0;
  for (auto _ : state)
    for (std::uint64_t i = 0; i < 400; ++i) {
      const SweepTask task = task_of(i, 1);
      auto lines = lines_at(task, static_cast<double>(i), CellRule::kCommonLines);
      if (lines.size() > 11) lines.resize(11);
      LineCosts costs(lines, task.air, task.ends);
      const Route pattern = quickest_pattern(costs, 0, 6);
      const double best = route_time(costs, 0, quickest_order(costs, 0, pattern));
      const double gap = route_time(costs, 0, improved(costs, 0, pattern, 20)) / best - 1;
      worst = std::max(worst, gap);
      mean += gap;
      ++count;
    }
  state.counters["worst_%"] = 100 * worst;
  state.counters["mean_%"] = 100 * mean / count;
}
BENCHMARK(order_gap)->Iterations(1)->Unit(benchmark::kMillisecond);

// A square of `range` lines with a hole.
void coverage(benchmark::State& state) {
  CoverageQuery q;
  q.area = {{0, 0}, {2000, 0}, {2000, 2000}, {0, 2000}};
  q.holes = {{{900, 900}, {1100, 950}, {1000, 1200}}};
  q.swath = 2000 / static_cast<double>(state.range(0));
  q.limits = kLimits;
  q.wind = {3, 4};
  q.aircraft.assign(static_cast<std::size_t>(state.range(1)), {FlightState{}, {}});
  double longest = 0;
  for (auto _ : state) longest = plan_coverage(q).longest;
  state.counters["longest_s"] = longest;
}
BENCHMARK(coverage)
    ->Args({10, 1})
    ->Args({30, 1})
    ->Args({100, 1})
    ->Args({300, 1})
    ->Args({30, 3})
    ->Args({100, 3})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace skein::solve
