// SPDX-License-Identifier: Apache-2.0
// What modes and failsafes cost an aircraft at each control step.

#include <benchmark/benchmark.h>

#include <vector>

#include "skein/layer/autopilot/modes/geofence.h"
#include "skein/layer/autopilot/modes/home_energy.h"
#include "skein/layer/autopilot/modes/mode_logic.h"
#include "skein/layer/autopilot/modes/motor_watch.h"

namespace skein::autopilot {
namespace {

const Time kStep = Time::from_ns(10'000'000);

// Nothing happens: link, satellites and transmitter are heard, a mission is flown.
void quiet_step(benchmark::State& state) {
  const ModeRules rules({}, AirframeKind::kFixedWing);
  std::vector<ModeLogic> fleet(static_cast<std::size_t>(state.range(0)),
                               ModeLogic(rules));
  std::vector<ModeInput> inputs(fleet.size());
  for (std::size_t k = 0; k < fleet.size(); ++k) {
    inputs[k].pilot.emplace();
    inputs[k].command = CommandKind::kMission;
    fleet[k].step(inputs[k]);
    inputs[k].command = CommandKind::kNone;
  }
  std::size_t k = 0;
  Time now;
  for (auto _ : state) {
    if (k == fleet.size()) {
      k = 0;
      now += kStep;
    }
    ModeInput& in = inputs[k];
    in.now = in.link_heard = in.gnss_fix = in.pilot->time = now;
    benchmark::DoNotOptimize(fleet[k].step(in).order);
    ++k;
  }
  state.counters["bytes"] = sizeof(ModeLogic);
}
BENCHMARK(quiet_step)->Arg(1)->Arg(100)->Arg(10'000);

// Something happens at every step: a command comes.
void busy_step(benchmark::State& state) {
  const ModeRules rules({}, AirframeKind::kFixedWing);
  ModeLogic logic(rules);
  ModeInput in;
  in.command = CommandKind::kGuided;
  for (auto _ : state) {
    in.now += kStep;
    benchmark::DoNotOptimize(logic.step(in).order);
  }
}
BENCHMARK(busy_step);

// In a fence of 24 corners, 2 km about the middle: up to 500 m out, or up to the edge.
void fence_step(benchmark::State& state) {
  GeofenceOptions options;
  options.area.emplace_back();
  for (int k = 0; k < 24; ++k)
    options.area[0].push_back(2000 * geo::unit(k * geo::kPi / 12));
  options.ceiling_msl = 500;
  const Geofence fence(options);
  FenceWatch watch(fence);
  const double reach = static_cast<double>(state.range(0));
  Vec3 p(0, 0, -100);
  double speed = 0.2;
  for (auto _ : state) {
    p.x() += speed;
    if (p.x() > reach || p.x() < -reach) speed = -speed;
    benchmark::DoNotOptimize(watch.step(p, Vec3::Zero(), true));
  }
}
BENCHMARK(fence_step)->Arg(500)->Arg(1980);

void fence_measured(benchmark::State& state) {
  GeofenceOptions options;
  options.area.emplace_back();
  for (int k = 0; k < 24; ++k)
    options.area[0].push_back(2000 * geo::unit(k * geo::kPi / 12));
  const Geofence fence(options);
  Vec3 p(0, 0, -100);
  for (auto _ : state) {
    p.x() += 0.1;
    benchmark::DoNotOptimize(fence.clearance(p, true));
  }
}
BENCHMARK(fence_measured);

void route_home(benchmark::State& state) {
  const HomeFlight flight{.airspeed = 15, .power_level = 60};
  Vec2 p(300, 400);
  for (auto _ : state) {
    p.x() += 0.1;
    benchmark::DoNotOptimize(home_need(-p, 100, {3, 4}, flight).energy);
  }
}
BENCHMARK(route_home);

void motor_step(benchmark::State& state) {
  MotorWatch watch({});
  Actuators commanded;
  Time now;
  for (auto _ : state) {
    now += kStep;
    benchmark::DoNotOptimize(watch.step(now, 0, commanded));
  }
}
BENCHMARK(motor_step);

}  // namespace
}  // namespace skein::autopilot
