// Cost of random numbers, turbulence and sensors, each per call, and of the usual suite
// of sensors per inner step of a vehicle at 100 Hz.

#include <benchmark/benchmark.h>

#include "base/random.h"

namespace skein {
namespace {

void one_normal(benchmark::State& state) {
  RandomStream stream(1, 0, Purpose::kTest);
  double sum = 0;
  for (auto _ : state) sum += stream.normal();
  benchmark::DoNotOptimize(sum);
}
BENCHMARK(one_normal);

void four_normals(benchmark::State& state) {
  RandomStream stream(1, 0, Purpose::kTest);
  double sum = 0;
  for (auto _ : state) {
    const auto n = stream.normals4();
    sum += n[0] + n[1] + n[2] + n[3];
  }
  benchmark::DoNotOptimize(sum);
}
BENCHMARK(four_normals);

}  // namespace
}  // namespace skein
