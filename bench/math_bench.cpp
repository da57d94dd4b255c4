// SPDX-License-Identifier: Apache-2.0
// Cost of the elementary functions of base/math.h next to the system's.
//
// Both take turns over the same 4,096 arguments; counters are medians of 25 turns:
// ours_ns and system_ns for one call, ratio of the two.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "skein/base/math.h"
#include "skein/base/random.h"

namespace skein {
namespace {

constexpr int kArguments = 4096, kTurns = 25, kPasses = 20;

template <class Function>
double ns_per_call(Function function, const std::vector<double>& arguments) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  for (int pass = 0; pass < kPasses; ++pass)
    for (const double x : arguments) benchmark::DoNotOptimize(function(x));
  const std::chrono::duration<double, std::nano> took = Clock::now() - begin;
  return took.count() / (kPasses * static_cast<double>(arguments.size()));
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

template <class Ours, class Systems>
void compare(benchmark::State& state, Ours ours, Systems systems, double low,
             double high) {
  RandomStream random(3, 0, Purpose::kTest);
  std::vector<double> arguments;
  for (int i = 0; i < kArguments; ++i) arguments.push_back(random.uniform(low, high));
  std::vector<double> our_ns, system_ns, ratio;
  for (auto _ : state)
    for (int turn = 0; turn < kTurns; ++turn) {
      our_ns.push_back(ns_per_call(ours, arguments));
      system_ns.push_back(ns_per_call(systems, arguments));
      ratio.push_back(our_ns.back() / system_ns.back());
    }
  state.counters["ours_ns"] = median(our_ns);
  state.counters["system_ns"] = median(system_ns);
  state.counters["ratio"] = median(ratio);
}

#define SKEIN_COMPARE(name, low, high)                       \
  BENCHMARK_CAPTURE(                                         \
      compare, name, [](double x) { return math::name(x); }, \
      [](double x) { return std::name(x); }, low, high)      \
      ->Unit(benchmark::kMillisecond)                        \
      ->Iterations(1)
#define SKEIN_COMPARE_TWO(name, second, low, high)                   \
  BENCHMARK_CAPTURE(                                                 \
      compare, name, [](double x) { return math::name(x, second); }, \
      [](double x) { return std::name(x, second); }, low, high)      \
      ->Unit(benchmark::kMillisecond)                                \
      ->Iterations(1)

SKEIN_COMPARE(sin, -7, 7);
SKEIN_COMPARE(cos, -7, 7);
SKEIN_COMPARE(tan, -1.5, 1.5);
SKEIN_COMPARE(asin, -1, 1);
SKEIN_COMPARE(acos, -1, 1);
SKEIN_COMPARE(atan, -50, 50);
SKEIN_COMPARE_TWO(atan2, 1.3, -10, 10);
SKEIN_COMPARE(tanh, -5, 5);
SKEIN_COMPARE(exp, -30, 30);
SKEIN_COMPARE(expm1, -30, 30);
SKEIN_COMPARE(log, 1e-6, 1e6);
SKEIN_COMPARE(log1p, -0.9, 1e3);
SKEIN_COMPARE_TWO(pow, 5.2559, 0.5, 1.5);
SKEIN_COMPARE_TWO(hypot, 1.3, -10, 10);
SKEIN_COMPARE(cbrt, -1e3, 1e3);
SKEIN_COMPARE(erf, -4, 4);
SKEIN_COMPARE(erfc, -4, 6);

}  // namespace
}  // namespace skein
