// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <vector>

#include "skein/base/random.h"
#include "skein/layer/reasoning/perimeter/pointwise/pointwise_kinds.h"
#include "skein/model/probability/half_space_update.h"

namespace skein {
namespace {

// Control points on a circle and readings around it, gated as an estimator would.
struct Work {
  std::vector<model::ControlPoint> points;
  std::vector<Vec2> aircraft;
  std::vector<model::Side> sides;
};

Work make_work() {
  RandomStream random(1, 0, Purpose::kTest);
  Work work;
  for (int i = 0; i < 1024; ++i) {
    model::ControlPoint point;
    const Vec2 radial = geo::unit(random.uniform(0, 2 * geo::kPi));
    point.mean << 500 * radial, 3 * radial;
    point.covariance.diagonal() << 10816, 10816, 0.003364, 0.003364;
    predict_point(point, 100, 1e-6);
    work.points.push_back(point);
    const Vec2 offset =
        random.uniform(5, 300) * geo::unit(random.uniform(0, 2 * geo::kPi));
    work.aircraft.push_back(point.position() + offset);
    work.sides.push_back(random.uniform() < 0.2 ? model::Side::kBelow
                                                : model::Side::kAbove);
  }
  return work;
}

// One QKF update of one control point; the copy of the prior point is counted in.
void QkfUpdate(benchmark::State& state) {
  const Work work = make_work();
  std::size_t i = 0;
  for (auto _ : state) {
    model::ControlPoint point = work.points[i];
    half_space_update(point, work.aircraft[i], 1, work.sides[i]);
    benchmark::DoNotOptimize(point);
    i = (i + 1) % work.points.size();
  }
  state.SetItemsProcessed(state.iterations());
  state.counters["per_update"] =
      benchmark::Counter(static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(QkfUpdate);

// The reference: the same update without the truncation, that is an ordinary Kalman
// update of a range.
void KalmanUpdate(benchmark::State& state) {
  const Work work = make_work();
  std::size_t i = 0;
  for (auto _ : state) {
    model::ControlPoint point = work.points[i];
    const model::LineOfSight seen = look_at(point, work.aircraft[i], 1);
    correct_point(point, seen, {.mean = 50, .variance = 0});
    benchmark::DoNotOptimize(point);
    i = (i + 1) % work.points.size();
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(KalmanUpdate);

// One reading given to a whole estimator of 60 points, gate and expected reading
// included.
void Reading(benchmark::State& state) {
  const perimeter::PointwiseKind& kind =
      perimeter::pointwise_kinds()[static_cast<std::size_t>(state.range(0))];
  const auto estimator = make_pointwise(kind, {}, {}, 1);
  double bearing = 0, now = 0;
  for (auto _ : state) {
    now += 1;
    bearing += 0.05;
    estimator->predict(Time::from_seconds(now));
    estimator->observe(FireReading{Time::from_seconds(now), EntityId{0},
                                   (500 + 3 * now - 100) * geo::unit(bearing), 2, true});
  }
  state.SetLabel(kind.name);
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(Reading)->DenseRange(0, 6);

}  // namespace
}  // namespace skein
