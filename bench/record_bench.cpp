// SPDX-License-Identifier: Apache-2.0
// How fast runs are recorded and beliefs compared with the truth.

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "skein/base/random.h"
#include "skein/record/figures/metrics.h"
#include "skein/record/figures/reading_ages.h"
#include "skein/record/store/run_recorder.h"
#include "skein/record/store/summary_recorder.h"

namespace skein::record {
namespace {

geo::Ring rough_circle(double radius, int count, double roughness) {
  RandomStream random(1, 0, Purpose::kTest);
  geo::Ring ring;
  for (int i = 0; i < count; ++i)
    ring.push_back((radius + roughness * random.normal()) *
                   geo::unit(2 * geo::kPi * i / count));
  return ring;
}

BoundaryEstimate belief_of(int points) {
  BoundaryEstimate belief;
  belief.rings.emplace_back();
  for (const Vec2& p : rough_circle(520, points, 20))
    belief.rings[0].push_back({p, p.normalized(), 20, 0.1, 0.2});
  return belief;
}

// One row in two is a truth, the other an estimate, as a simulation gives them.
void give_rows(Recorder& recorder, std::int64_t rows) {
  VehicleState state;
  NavEstimate estimate;
  for (std::int64_t i = 0; i < rows / 2; ++i) {
    const Time now = Time::from_ns(i * 1000000);
    const EntityId id{static_cast<std::uint32_t>(i % 4)};
    state.p_N = Vec3(0.1 * static_cast<double>(i), 20, -300);
    estimate.time = now;
    estimate.p_N = state.p_N;
    recorder.record(TruthRecord{now, id, state});
    recorder.record(EstimateRecord{id, estimate, {}});
    benchmark::DoNotOptimize(recorder.step_done(now));
  }
}

// From the first row to the closed file, hashing included.
void write_rows(benchmark::State& state) {
  const std::int64_t rows = state.range(0);
  const auto folder = std::filesystem::temp_directory_path() /
                      ("skein_record_bench_" + std::to_string(getpid()));
  for (auto _ : state) {
    auto recorder = RunRecorder::create(folder, {}).value();
    give_rows(*recorder, rows);
    if (!recorder->close()) state.SkipWithError("the run could not be written");
    recorder.reset();
    std::filesystem::remove_all(folder);
  }
  state.counters["rows"] = benchmark::Counter(
      static_cast<double>(state.iterations() * rows), benchmark::Counter::kIsRate);
}
BENCHMARK(write_rows)->Arg(1000000)->UseRealTime()->Unit(benchmark::kMillisecond);

// What recording costs the simulation's own thread as long as the disk keeps up.
void queue_rows(benchmark::State& state) {
  const auto folder = std::filesystem::temp_directory_path() /
                      ("skein_record_bench_" + std::to_string(getpid()));
  auto recorder = RunRecorder::create(folder, {}).value();
  for (auto _ : state) {
    give_rows(*recorder, 1000);
    state.PauseTiming();
    usleep(4000);
    state.ResumeTiming();
  }
  state.counters["s_per_row"] =
      benchmark::Counter(static_cast<double>(state.iterations() * 1000),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  recorder.reset();
  std::filesystem::remove_all(folder);
}
BENCHMARK(queue_rows)->Iterations(200)->Unit(benchmark::kMicrosecond);

void hash_rows(benchmark::State& state) {
  SummaryRecorder recorder({});
  for (auto _ : state) give_rows(recorder, 1000);
  state.counters["s_per_row"] =
      benchmark::Counter(static_cast<double>(state.iterations() * 1000),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(hash_rows)->Unit(benchmark::kMicrosecond);

// Believed points against edges of the true boundary.
void compare_boundaries(benchmark::State& state) {
  const geo::Region truth = {rough_circle(500, static_cast<int>(state.range(1)), 1)};
  const BoundaryEstimate belief = belief_of(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(perimeter_metrics(truth, belief));
}
BENCHMARK(compare_boundaries)
    ->Args({60, 300})
    ->Args({120, 2000})
    ->Args({300, 2000})
    ->Unit(benchmark::kMicrosecond);

// The ages of a boundary of 6 km that grows by 15 m each time.
void follow_ages(benchmark::State& state) {
  std::vector<TrueBoundary> truths;
  for (int i = 0; i < 20; ++i)
    truths.emplace_back(geo::Region{rough_circle(1000 + 15 * i, 600, 1)});
  const BoundaryEstimate belief = belief_of(120);
  for (auto _ : state) {
    ReadingAges ages;
    for (const TrueBoundary& truth : truths)
      benchmark::DoNotOptimize(ages.ages(Time{}, truth, belief));
  }
  state.counters["s_per_call"] =
      benchmark::Counter(static_cast<double>(state.iterations() * 20),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(follow_ages)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace skein::record
