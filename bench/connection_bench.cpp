// SPDX-License-Identifier: Apache-2.0
// Cost of one connection over random cases: the median, per core.
//
// Each case of a set of 2,000 is solved many times between two readings of the clock; the
// counters median_ns, mean_ns and p99_ns are of the cases' mean times.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "skein/base/random.h"
#include "skein/model/connection/connection.h"

namespace skein::model {
namespace {

ConnectionQuery random_query(RandomStream& random, double box, double max_wind) {
  ConnectionQuery q;
  const double turn = 2 * geo::kPi;
  q.air.airspeed = 20;
  q.air.turn_radius = 50;
  q.air.wind = 20 * max_wind * random.uniform() * geo::unit(turn * random.uniform());
  q.from.position = 50 * box * Vec2(random.uniform(), random.uniform());
  q.from.course = turn * random.uniform();
  q.to.position = 50 * box * Vec2(random.uniform(), random.uniform());
  q.to.course = turn * random.uniform();
  return q;
}

void connections(benchmark::State& state, double box, double max_wind) {
  RandomStream random(7, 0, Purpose::kTest);
  std::vector<ConnectionQuery> queries;
  for (int i = 0; i < 2000; ++i) queries.push_back(random_query(random, box, max_wind));
  constexpr int kTimes = 200;
  std::vector<double> ns;
  using Clock = std::chrono::steady_clock;
  for (auto _ : state) {
    ns.clear();
    for (const ConnectionQuery& q : queries) {
      const auto begin = Clock::now();
      for (int k = 0; k < kTimes; ++k)
        benchmark::DoNotOptimize(connect(q.from, q.to, q.air));
      const std::chrono::duration<double, std::nano> took = Clock::now() - begin;
      ns.push_back(took.count() / kTimes);
    }
  }
  double sum = 0;
  for (const double each : ns) sum += each;
  std::sort(ns.begin(), ns.end());
  state.counters["median_ns"] = ns[ns.size() / 2];
  state.counters["mean_ns"] = sum / static_cast<double>(ns.size());
  state.counters["p99_ns"] = ns[ns.size() * 99 / 100];
}

// One after the other, as a batch meets them: nothing is predicted from the last time.
void batch(benchmark::State& state, double box, double max_wind) {
  RandomStream random(8, 0, Purpose::kTest);
  std::vector<ConnectionQuery> queries;
  for (int i = 0; i < 20'000; ++i) queries.push_back(random_query(random, box, max_wind));
  std::vector<Connection> out(queries.size());
  for (auto _ : state) {
    connect(queries, out);
    benchmark::DoNotOptimize(out.data());
  }
  state.counters["each_ns"] = benchmark::Counter(
      static_cast<double>(queries.size()) * 1e-9,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(connections, calm_20_radii, 20, 0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(connections, calm_4_radii, 4, 0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(connections, wind_20_radii, 20, 0.8)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(connections, wind_4_radii, 4, 0.8)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(batch, calm_20_radii, 20, 0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(batch, calm_4_radii, 4, 0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(batch, wind_20_radii, 20, 0.8)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(batch, wind_4_radii, 4, 0.8)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace skein::model
