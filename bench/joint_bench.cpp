// SPDX-License-Identifier: Apache-2.0
// Cost of the joint estimator. items = calls of the timed step; time per item is what
// counts.

#include <benchmark/benchmark.h>

#include "skein/geo/vec.h"
#include "skein/layer/reasoning/perimeter/joint/joint_estimator.h"

namespace {

using skein::Crossing;
using skein::FireReading;
using skein::Time;
using skein::Vec2;
namespace geo = skein::geo;
using skein::perimeter::JointEstimator;
using skein::perimeter::JointOptions;

skein::PerimeterPrior windy() {
  skein::PerimeterPrior prior;
  prior.wind = {0.3, 0.2};
  return prior;
}

// One second of two aircraft: prediction, then two readings that both change the belief.
// Argument: knots of the radius (and as many of the rate).
void predict_and_two_crossings(benchmark::State& state) {
  JointOptions options;
  options.knots = static_cast<int>(state.range(0));
  JointEstimator estimator(windy(), options);
  int second = 0;
  for (auto _ : state) {
    ++second;
    const Time now = Time::from_seconds(second);
    estimator.predict(now);
    for (std::uint32_t id = 0; id < 2; ++id) {
      const double bearing = 0.013 * second + 3 * id;
      const double radius = estimator.filter(0).at(bearing).radius;
      // Towards and away from the fire in turn, with a reading between, as on a real
      // track.
      const bool in = second % 2 == 0;
      const Vec2 e = geo::unit(bearing);
      estimator.observe(
          Crossing{now, {id + (in ? 2U : 0U)}, radius * e, (in ? -12 : 12) * e, 1, in});
    }
  }
  state.SetItemsProcessed(state.iterations());
  state.counters["unknowns"] = 2 * static_cast<double>(options.knots) + 2;
  state.counters["hypotheses"] = static_cast<double>(estimator.weights().size());
}
BENCHMARK(predict_and_two_crossings)->Arg(60)->Arg(90)->Arg(120);

// The usual second: no reading says anything new.
void predict_and_two_expected_readings(benchmark::State& state) {
  JointEstimator estimator(windy(), JointOptions{});
  int second = 0;
  for (auto _ : state) {
    const Time now = Time::from_seconds(++second);
    estimator.predict(now);
    for (std::uint32_t id = 0; id < 2; ++id) {
      estimator.observe(
          FireReading{now, {id}, 50 * geo::unit(0.013 * second + 3 * id), 1, true});
    }
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(predict_and_two_expected_readings);

void ring_of_60_points(benchmark::State& state) {
  JointEstimator estimator(windy(), JointOptions{});
  estimator.predict(Time::from_seconds(10));
  for (auto _ : state) benchmark::DoNotOptimize(estimator.boundary());
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(ring_of_60_points);

void copy(benchmark::State& state) {
  const JointEstimator estimator(windy(), JointOptions{});
  for (auto _ : state) benchmark::DoNotOptimize(estimator.clone());
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(copy);

}  // namespace
