// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include "skein/layer/autopilot/control/fixed_wing_control.h"
#include "skein/layer/autopilot/control/multirotor_control.h"

namespace skein::autopilot {
namespace {

constexpr double kStep = 0.01;

FixedWingAirframe small_uav() {
  FixedWingAirframe a;
  a.mass = 11;
  a.slowest = 17;
  a.cruise = 25;
  a.fastest = 36;
  a.bank_limit = 0.7;
  a.pitch_up = 0.4;
  a.pitch_down = -0.4;
  a.climb_rate = 4;
  a.sink_rate = 3;
  a.trim_alpha = 0.05;
  a.trim_elevator = -0.2;
  a.trim_throttle = 0.5;
  return a;
}

MultirotorAirframe rotors(int count) {
  MultirotorAirframe a;
  a.mass = 1.5;
  a.inertia = Vec3(0.02, 0.02, 0.04);
  for (int k = 0; k < count; ++k)
    a.rotors.push_back(
        {0.25 * geo::unit(geo::kPi / count * (2 * k + 1)), k % 2 == 0 ? 1.0 : -1.0});
  a.thrust_max = 32.0 / count;
  a.torque_ratio = 0.016;
  a.tilt_limit = 0.6;
  a.fastest = 12;
  a.climb_rate = 4;
  a.sink_rate = 3;
  return a;
}

// States of a restless flight, so that no branch is always taken.
std::array<NavState, 64> states(double airspeed) {
  std::array<NavState, 64> all;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double t = 0.1 * static_cast<double>(k);
    NavState& nav = all[k];
    nav.p_N = Vec3(3 * std::sin(t), 2 * std::cos(t), -100 - std::sin(3 * t));
    nav.q_NB = geo::from_euler({0.5 * std::sin(t), 0.1 * std::cos(2 * t), t});
    nav.v_N = nav.q_NB * Vec3(airspeed, 0.3 * std::sin(t), 0.5 * std::cos(t));
    nav.w_NB_B = Vec3(0.2 * std::sin(5 * t), 0.1 * std::cos(4 * t), 0.1);
    nav.wind_N = Vec3(3, 2, 0);
    nav.airspeed = airspeed + std::sin(2 * t);
  }
  return all;
}

void fixed_wing_control(benchmark::State& state) {
  FixedWingControl control(small_uav(), {});
  const auto nav = states(25);
  FixedWingDemand demand;
  demand.altitude_msl = 100;
  demand.airspeed = 25;
  std::size_t k = 0;
  for (auto _ : state) {
    demand.lateral_acceleration = 0.05 * static_cast<double>(k & 63);
    benchmark::DoNotOptimize(control.control(demand, nav[k++ & 63], kStep));
  }
}
BENCHMARK(fixed_wing_control);

void fixed_wing_stabilize(benchmark::State& state) {
  FixedWingControl control(small_uav(), {});
  const auto nav = states(25);
  std::size_t k = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(control.stabilize({0.3, 0.1, 0, 0.5}, nav[k++ & 63], kStep));
}
BENCHMARK(fixed_wing_stabilize);

void multirotor_control(benchmark::State& state) {
  MultirotorControl control(rotors(static_cast<int>(state.range(0))), {});
  const auto nav = states(2);
  MultirotorDemand demand;
  demand.altitude_msl = 100;
  std::size_t k = 0;
  for (auto _ : state) {
    demand.heading = 0.1 * static_cast<double>(k & 63);
    benchmark::DoNotOptimize(control.control(demand, nav[k++ & 63], kStep));
  }
}
BENCHMARK(multirotor_control)->Arg(4)->Arg(6)->Arg(8);

}  // namespace
}  // namespace skein::autopilot
