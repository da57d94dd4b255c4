// SPDX-License-Identifier: Apache-2.0
// Cost of a fixed wing's physics: a step at 100 Hz, its parts, a trim.

#include <benchmark/benchmark.h>

#include <cmath>

#include "skein/layer/asset/fixed_wing/fixed_wing_plant.h"
#include "skein/layer/asset/fixed_wing/test/aircraft.h"
#include "skein/layer/asset/fixed_wing/trim.h"
#include "skein/model/atmosphere/atmosphere.h"

namespace skein::asset {
namespace {

// Gentle manoeuvres with all surfaces at work; the second argument is the wind [m/s].
void step(benchmark::State& state, const FixedWingParameters& parameters) {
  const FixedWingPlant plant(parameters);
  const Air air{{4, -2, 0.3}, {0.01, -0.01, 0.005}};
  const VehicleState begin = plant.start({{0, 0, -300}, 0.5, air.wind_N, false});
  const auto frame = std::get<FixedWingAirframe>(plant.airframe());
  VehicleState vehicle = begin;
  Control control = Actuators{};
  Actuators& u = std::get<Actuators>(control);
  u[channel::kElevator] = frame.trim_elevator;
  u[channel::kThrottle] = frame.trim_throttle;
  int k = 0;
  for (auto _ : state) {
    if (k == 400) {
      k = 0;
      vehicle = begin;
    }
    // A square wave of four seconds.
    u[channel::kAileron] = k < 100 || k >= 300 ? 0.02 : -0.02;
    ++k;
    plant.step(vehicle, control, air, 0.01);
    benchmark::DoNotOptimize(vehicle);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(step, aerosonde, aerosonde());
BENCHMARK_CAPTURE(step, glider, glider());
BENCHMARK_CAPTURE(step, light_sport, light_sport());

void density(benchmark::State& state) {
  double altitude = 300;
  for (auto _ : state) {
    benchmark::DoNotOptimize(altitude);
    benchmark::DoNotOptimize(model::density_around(altitude));
  }
}
BENCHMARK(density);

void trim(benchmark::State& state) {
  const FixedWingModel model(aerosonde());
  for (auto _ : state) benchmark::DoNotOptimize(find_trim(model, {25, 0.02, 0.1, 300}));
}
BENCHMARK(trim);

}  // namespace
}  // namespace skein::asset
