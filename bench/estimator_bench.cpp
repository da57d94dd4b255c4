// SPDX-License-Identifier: Apache-2.0
// Cost of the estimator per inertial sample, and its consistency over many runs:
//
//   bench_estimator --benchmark_filter=step
//   bench_estimator --benchmark_filter=nees   (minutes; counters are the result)

#include <benchmark/benchmark.h>

#include <Eigen/Cholesky>

#include <variant>
#include <vector>

#include "skein/layer/autopilot/estimator/test/synthetic_flight.h"

namespace skein::autopilot {
namespace {

using testing::FlightPlan;
using testing::nees;
using testing::SyntheticFlight;

// Half a minute of flight, and what the sensors say in it, step by step.
struct Recording {
  std::vector<SensorSample> samples;
  std::vector<std::size_t> ends;  // of the steps
  EstimatorStart start;
};

Recording record(std::uint64_t seed) {
  Recording r;
  SyntheticFlight flight({}, {}, seed);
  r.start = flight.start({2, 3, 0.3, 0.02, 0.05, 2});
  for (int k = 0; k < 3000; ++k) {
    flight.step([&](const auto& sample) { r.samples.emplace_back(sample); });
    r.ends.push_back(r.samples.size());
  }
  return r;
}

// All vehicles of a fleet one after the other, step by step. 100 Hz inertial samples,
// 5 Hz fixes, 25 Hz barometer, magnetometer and airspeed.
void estimator_step(benchmark::State& state) {
  const auto fleet = static_cast<std::size_t>(state.range(0));
  const Recording r = record(1);
  std::int64_t steps = 0;
  for (auto _ : state) {
    state.PauseTiming();
    std::vector<FlightEstimator> all(fleet, FlightEstimator(EstimatorOptions{}, r.start));
    // Vehicles do not correct in the same step.
    for (std::size_t v = 0; v < fleet; ++v)
      for (std::size_t i = 0; i < r.ends[v % 10]; ++i) all[v].sense(r.samples[i]);
    state.ResumeTiming();
    const std::size_t last = fleet > 1000 ? 200 : r.ends.size() - 10;
    for (std::size_t k = 0; k < last; ++k)
      for (std::size_t v = 0; v < fleet; ++v) {
        const std::size_t at = k + v % 10 + 1;
        for (std::size_t i = r.ends[at - 1]; i < r.ends[at]; ++i)
          all[v].sense(r.samples[i]);
      }
    steps += static_cast<std::int64_t>(last * fleet);
    benchmark::DoNotOptimize(all);
  }
  state.SetItemsProcessed(steps);
}
BENCHMARK(estimator_step)->ArgName("fleet")->Arg(1)->Arg(100)->Arg(10000);

// Normalised error over Monte Carlo runs of 240 s: time means, and the share of seconds
// in which the mean over the runs is in its 95 % band.
void estimator_nees(benchmark::State& state) {
  FlightPlan plan;
  switch (state.range(0)) {
    case 0:
      plan.manoeuvres = false;
      break;
    case 1:
      break;
    case 2:
      plan.outage_from = 100;
      plan.outage_until = 130;
      break;
    case 3:
      plan.wind = {4.8, 6.4};
      plan.gust_sd = 2;
      break;
    default:
      plan.wind = {4.8, 6.4};
      plan.gust_sd = 2;
      plan.outage_from = 100;
      plan.outage_until = 130;
  }
  const auto runs = static_cast<int>(state.range(1));
  constexpr std::size_t kSeconds = 240;
  for (auto _ : state) {
    std::vector<double> moving(kSeconds), all(kSeconds), wind(kSeconds);
    for (int run = 0; run < runs; ++run) {
      SyntheticFlight flight({}, plan, 1000 + static_cast<std::uint64_t>(run));
      FlightEstimator estimator(EstimatorOptions{},
                                flight.start({2, 3, 0.3, 0.02, 0.05, 2}));
      for (std::size_t t = 0; t < kSeconds; ++t) {
        for (int k = 0; k < 100; ++k)
          flight.step([&](const auto& sample) { estimator.add(sample); });
        const auto add = [&](std::vector<double>& v, std::size_t a, std::size_t b) {
          v[t] += nees(flight.truth(), estimator, a, b) / runs;
        };
        add(moving, error::kAttitude, error::kSize);
        add(all, 0, error::kSize);
        add(wind, error::kWind, error::kWind + 2);
      }
    }
    const auto report = [&](const char* name, const std::vector<double>& v, double n) {
      double sum = 0, in = 0;
      for (double x : v) {
        sum += x;
        in += std::abs(x - n) < 1.96 * std::sqrt(2 * n / runs) ? 1 : 0;
      }
      state.counters[std::string(name) + "_mean"] = sum / kSeconds;
      state.counters[std::string(name) + "_in_band"] = in / kSeconds;
    };
    report("pva", moving, 9);
    report("all", all, error::kSize);
    report("wind", wind, 2);
  }
}
BENCHMARK(estimator_nees)
    ->ArgNames({"case", "runs"})
    ->ArgsProduct({{0, 1, 2, 3, 4}, {100}})
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace skein::autopilot
