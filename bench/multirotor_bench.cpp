// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <memory>
#include <variant>
#include <vector>

#include "skein/layer/asset/body/battery.h"
#include "skein/layer/asset/multirotor/multirotor_plant.h"
#include "skein/layer/asset/performance/performance_plant.h"
#include "skein/layer/autopilot/control/multirotor_control.h"

namespace skein::asset {
namespace {

VehicleState hovering(const MultirotorPlant& plant, Actuators& throttles) {
  const VehicleState state = plant.start({{0, 0, -100}, 0.3, {4, 3, 0}, false});
  for (std::size_t k = 0; k < Actuators::kMaxChannels; ++k)
    throttles[k] = state.actuators[k] / MultirotorParameters{}.fastest_rotor;
  return state;
}

// Steps of `range` multirotors in turn; time per step of one.
void multirotor_step(benchmark::State& run) {
  const MultirotorPlant plant{MultirotorParameters{}};
  Actuators throttles;
  std::vector<VehicleState> states(static_cast<std::size_t>(run.range(0)),
                                   hovering(plant, throttles));
  const Control control = throttles;
  Air air;
  air.wind_N = {4, 3, 0};
  std::size_t i = 0;
  for (auto _ : run) {
    plant.step(states[i], control, air, 0.01);
    benchmark::DoNotOptimize(states[i].p_N);
    if (++i == states.size()) {
      i = 0;
      for (VehicleState& s : states) s.energy.charge = 1;
    }
  }
}
BENCHMARK(multirotor_step)->Arg(1)->Arg(100)->Arg(10000);

// The same with the cascade that flies them: each holds a point in wind that changes, by
// the truth.
void multirotor_step_with_cascade(benchmark::State& run) {
  struct Flying {
    VehicleState state;
    autopilot::MultirotorControl control;
  };
  const MultirotorPlant plant{MultirotorParameters{}};
  const auto frame = std::get<MultirotorAirframe>(plant.airframe());
  const auto setup = std::make_shared<const autopilot::MultirotorSetup>(
      frame, autopilot::MultirotorGains{});
  Actuators throttles;
  const Flying first{hovering(plant, throttles), autopilot::MultirotorControl(setup)};
  std::vector<Flying> all(static_cast<std::size_t>(run.range(0)), first);
  autopilot::MultirotorDemand demand;
  demand.altitude_msl = 100;
  demand.heading = 0.3;
  Air air;
  std::size_t i = 0, round = 0;
  for (auto _ : run) {
    VehicleState& s = all[i].state;
    air.wind_N = {round / 100 % 2 == 0 ? 4.0 : 2.0, 3, 0};
    autopilot::NavState nav;
    nav.p_N = s.p_N;
    nav.v_N = s.v_N;
    nav.q_NB = s.q_NB;
    nav.w_NB_B = s.w_NB_B;
    plant.step(s, all[i].control.control(demand, nav, 0.01), air, 0.01);
    benchmark::DoNotOptimize(s.p_N);
    s.energy.charge = 1;
    if (++i == all.size()) {
      i = 0;
      ++round;
    }
  }
  if ((all.front().state.p_N - first.state.p_N).norm() > 5)
    run.SkipWithError("it does not hold its place");
}
BENCHMARK(multirotor_step_with_cascade)->Arg(1)->Arg(100)->Arg(10000);

void performance_step(benchmark::State& run) {
  const PerformancePlant plant{PerformanceParameters{}};
  VehicleState state = plant.start({});
  const Control control = FlightCommand{0.3, 45, 0};
  const Air air;
  for (auto _ : run) {
    plant.step(state, control, air, 0.01);
    benchmark::DoNotOptimize(state.p_N);
    state.energy.charge = 1;
  }
}
BENCHMARK(performance_step);

void battery_draw(benchmark::State& run) {
  const Battery battery{BatteryParameters{}};
  Energy energy;
  energy.charge = 0.7;
  double power = 100;
  for (auto _ : run) {
    benchmark::DoNotOptimize(power);
    benchmark::DoNotOptimize(battery.draw(energy, {}, power, 1e-7));
  }
}
BENCHMARK(battery_draw);

}  // namespace
}  // namespace skein::asset
