// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include "skein/layer/reasoning/perimeter/ensemble/ensemble_estimator.h"
#include "skein/model/levelset/advance.h"
#include "skein/model/levelset/reinitialise.h"

namespace skein {
namespace {

model::Field circle(int nodes) {
  model::Field phi{{Vec2::Zero(), 10, nodes, nodes}, {}};
  const double middle = 5.0 * (nodes - 1);
  for (int r = 0; r < nodes; ++r)
    for (int c = 0; c < nodes; ++c)
      phi.values.push_back(static_cast<float>(
          (phi.grid.node(r, c) - Vec2(middle, middle)).norm() - 0.5 * middle));
  return phi;
}

void per_item(benchmark::State& state, double items) {
  state.counters["per_item"] =
      benchmark::Counter(items * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

// One step of one front; an item is a node in the band.
void advance_front(benchmark::State& state) {
  const model::Field start = circle(201);
  const std::vector<float> speed(start.values.size(), 0.2F);
  double band_nodes = 0;
  for (const float v : start.values) band_nodes += std::abs(v) < 60 ? 1 : 0;
  model::Field phi = start;
  for (auto _ : state) {
    phi = start;
    model::advance(phi, {speed, Vec2(0.05, 0)}, 20, 60);
    benchmark::DoNotOptimize(phi.values.data());
  }
  per_item(state, band_nodes);
}
BENCHMARK(advance_front)->Unit(benchmark::kMicrosecond);

// One redistancing; an item is a node of the grid.
void reinitialise_front(benchmark::State& state) {
  model::Field phi = circle(201);
  for (auto _ : state) {
    model::reinitialise(phi);
    benchmark::DoNotOptimize(phi.values.data());
  }
  per_item(state, static_cast<double>(phi.values.size()));
}
BENCHMARK(reinitialise_front)->Unit(benchmark::kMicrosecond);

PerimeterPrior prior() {
  PerimeterPrior p;
  p.radius = 500;
  p.radius_sd = 60;
  p.rate = 0.2;
  p.rate_sd = 0.15;
  p.wind_sd = 0.05;
  return p;
}

// 20 simulated seconds of 40 fronts; an item is a member.
void predict(benchmark::State& state) {
  perimeter::EnsembleEstimator estimator(prior(), {});
  double t = 0;
  for (auto _ : state) estimator.predict(Time::from_seconds(t += 20));
  per_item(state, 40);
}
BENCHMARK(predict)->Unit(benchmark::kMillisecond)->Iterations(60);

// One crossing, on a belief that is refreshed every 36 crossings.
void observe_crossing(benchmark::State& state) {
  const perimeter::EnsembleEstimator fresh(prior(), {});
  perimeter::EnsembleEstimator estimator = fresh;
  int k = 0;
  for (auto _ : state) {
    if (k % 36 == 0) {
      state.PauseTiming();
      estimator = fresh;
      state.ResumeTiming();
    }
    const Vec2 out = geo::unit(k * geo::kPi / 18);
    estimator.observe(
        Crossing{Time(), EntityId{1}, 500 * out, 20 * geo::turned_right(out), 2, false});
    ++k;
  }
  per_item(state, 1);
}
BENCHMARK(observe_crossing)->Unit(benchmark::kMicrosecond);

// A reading that says nothing new, the usual case.
void observe_expected_reading(benchmark::State& state) {
  perimeter::EnsembleEstimator estimator(prior(), {});
  for (auto _ : state)
    estimator.observe(FireReading{Time(), EntityId{1}, Vec2(100, 100), 2, true});
  per_item(state, 1);
}
BENCHMARK(observe_expected_reading)->Unit(benchmark::kMicrosecond);

void boundary(benchmark::State& state) {
  const perimeter::EnsembleEstimator estimator(prior(), {});
  for (auto _ : state) {
    const BoundaryEstimate b = estimator.boundary();
    benchmark::DoNotOptimize(b.rings.data());
  }
  per_item(state, 1);
}
BENCHMARK(boundary)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace skein
