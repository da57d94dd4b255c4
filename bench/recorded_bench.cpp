// SPDX-License-Identifier: Apache-2.0
// Recorded fires as truth: what the simulation pays per step and at the start.

#include <benchmark/benchmark.h>

#include <filesystem>

#include "skein/layer/environment/recorded/recorded_fire.h"

namespace {

using namespace skein;
using namespace skein::environment;

struct Loaded {
  RecordedFireSummary summary;
  std::unique_ptr<Phenomenon> fire;
};

bool load(benchmark::State& state, const char* name, Loaded& loaded) {
  RecordedFireOptions options;
  options.path = std::string(SKEIN_SHARED_DATA) + "/fires/" + name;
  std::vector<std::string> notes;
  const auto summary = summarise_recorded_fire(options, notes);
  if (!summary) {
    state.SkipWithError(summary.error().text().c_str());
    return false;
  }
  loaded.summary = summary.value();
  std::vector<std::string> warnings;
  auto fire = make_recorded_fire(
      options, geo::LocalFrame::at(loaded.summary.origin).value(), warnings);
  if (!fire) {
    state.SkipWithError(fire.error().text().c_str());
    return false;
  }
  loaded.fire = std::move(fire).value();
  return true;
}

void bm_load(benchmark::State& state, const char* name) {
  for (auto _ : state) {
    Loaded loaded;
    if (!load(state, name, loaded)) return;
  }
}
BENCHMARK_CAPTURE(bm_load, bridge, "bridge_2021")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bm_load, river, "river_2021")->Unit(benchmark::kMillisecond);

void bm_inside(benchmark::State& state, const char* name) {
  Loaded loaded;
  if (!load(state, name, loaded)) return;
  loaded.fire->advance(Time::from_seconds(loaded.summary.duration / 2));
  const Vec2 size = loaded.summary.high - loaded.summary.low;
  double part = 0;
  for (auto _ : state) {
    part = part > 0.98 ? 0 : part + 0.0137;
    const Vec2 p = loaded.summary.low + Vec2(part * size.x(), (1 - part) * size.y());
    benchmark::DoNotOptimize(loaded.fire->inside(p));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(bm_inside, bridge, "bridge_2021");
BENCHMARK_CAPTURE(bm_inside, river, "river_2021");

void bm_region(benchmark::State& state, const char* name) {
  Loaded loaded;
  if (!load(state, name, loaded)) return;
  Time now;
  for (auto _ : state) {
    now += Time::from_seconds(loaded.summary.duration * 1e-5);
    loaded.fire->advance(now);
    benchmark::DoNotOptimize(loaded.fire->region().size());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(bm_region, bridge, "bridge_2021")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(bm_region, river, "river_2021")->Unit(benchmark::kMicrosecond);

}  // namespace
