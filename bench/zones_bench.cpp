// SPDX-License-Identifier: Apache-2.0
// What no-fly zones cost an agent: finding out which count, detours around them, and a
// leg that is planned anew.

#include <benchmark/benchmark.h>

#include <vector>

#include "skein/base/random.h"
#include "skein/data/airspace/airspace.h"
#include "skein/layer/reasoning/trajectory/detour_planner.h"
#include "skein/layer/reasoning/trajectory/zone_avoidance.h"
#include "skein/solve/path/aa_star.h"

namespace skein {
namespace {

// Discs and boxes over 4 km by 3 km; a disc lies on the line from the south to the north.
std::vector<Zone> scene(std::int64_t count) {
  RandomStream random(1, 1, Purpose::kTest);
  std::vector<Zone> zones;
  for (std::int64_t k = 0; k < count; ++k) {
    const Vec2 at = k == 0
                        ? Vec2(0, 30)
                        : Vec2(random.uniform(-1700, 1700), random.uniform(-1200, 1200));
    const double size = random.uniform(50, 150);
    if (k % 2 == 0)
      zones.push_back({.area = Disc{at, size}});
    else
      zones.push_back(
          {.area = geo::Ring{at, at + Vec2(size, 0), at + Vec2(size, 2 * size),
                             at + Vec2(0, 2 * size)}});
  }
  return zones;
}

const Vec2 kFrom(-2000, 0), kTo(2000, 0);

// A step of an agent far from zones that all count.
void guard_far(benchmark::State& state) {
  const std::vector<Zone> zones = scene(state.range(0));
  reasoning::ZoneAvoidance guard({}, FlightLimits{}, zones);
  NavEstimate nav;
  nav.p_N = {-5000, 0, -100};
  nav.v_N = {20, 0, 0};
  for (auto _ : state)
    benchmark::DoNotOptimize(guard.check(HoldCourse{0}, 0, nav, 100.0));
}
BENCHMARK(guard_far)->Arg(2)->Arg(20)->Arg(200);

// When zones come or go.
void draw_detours(benchmark::State& state) {
  const std::vector<Zone> zones = scene(state.range(0));
  for (auto _ : state) {
    const reasoning::DetourPlanner detours(zones, 100);
    benchmark::DoNotOptimize(&detours);
  }
}
BENCHMARK(draw_detours)->Arg(2)->Arg(20)->Arg(200)->Unit(benchmark::kMicrosecond);

void find_detour(benchmark::State& state) {
  const reasoning::DetourPlanner detours(scene(state.range(0)), 100);
  for (auto _ : state) benchmark::DoNotOptimize(detours.detour(kFrom, kTo));
}
BENCHMARK(find_detour)->Arg(2)->Arg(20)->Arg(200)->Unit(benchmark::kMicrosecond);

// A leg as RouteFlight has it planned; the second argument is the expansions. The time
// that the path takes is a counter.
void plan_leg(benchmark::State& state) {
  Airspace airspace;
  airspace.zones = scene(state.range(0));
  PathQuery query;
  query.start = {{kFrom.x(), kFrom.y(), -100}, 0};
  query.goal = {{kTo.x(), kTo.y(), -100}, 0};
  query.wind = {-2, 4};
  query.airspace = &airspace;
  query.budget.expansions = state.range(1);
  const solve::AaStar planner;
  double duration = 0;
  for (auto _ : state) duration = planner.plan(query).duration;
  state.counters["flight_s"] = duration;
}
BENCHMARK(plan_leg)
    ->ArgsProduct({{2, 20, 200}, {1000, 3000, 20000, 100000}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace skein
