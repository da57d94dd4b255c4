// SPDX-License-Identifier: Apache-2.0
// Cost of one aircraft: plant and autopilot per step, its agent per decision, and the
// path computations that strategies call most.

#include <benchmark/benchmark.h>

#include <array>
#include <vector>

#include "skein/base/random.h"
#include "skein/layer/asset/kinematic_plant.h"
#include "skein/layer/autopilot/simple_autopilot.h"
#include "skein/layer/reasoning/trajectory/zone_avoidance.h"
#include "skein/model/connection/point_connection.h"
#include "skein/model/path/dubins.h"

namespace skein {
namespace {

constexpr std::size_t kQueries = 1024;

struct Query {
  model::Pose from, to;
};

std::array<Query, kQueries> queries(double extent) {
  RandomStream random(1, 0, Purpose::kTest);
  const auto pose = [&] {
    const double x = random.uniform(-extent, extent), y = random.uniform(-extent, extent);
    return model::Pose{{x, y}, random.uniform(-geo::kPi, geo::kPi)};
  };
  std::array<Query, kQueries> all;
  for (Query& q : all) {
    q.from = pose();
    q.to = pose();
  }
  return all;
}

void dubins_shortest(benchmark::State& state) {
  const auto all = queries(500);
  std::size_t i = 0;
  for (auto _ : state) {
    const Query& q = all[i++ % kQueries];
    benchmark::DoNotOptimize(model::dubins(q.from, q.to, 60));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(dubins_shortest);

void time_to_point(benchmark::State& state) {
  const auto all = queries(1000);
  const Vec2 wind = static_cast<double>(state.range(0)) * geo::unit(0.7);
  std::size_t i = 0;
  for (auto _ : state) {
    const Query& q = all[i++ % kQueries];
    benchmark::DoNotOptimize(
        model::connect_to_point(q.from, q.to.position, {20, 60, wind}).time);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(time_to_point)->ArgName("wind_mps")->Arg(0)->Arg(3)->Arg(8);

void plant_step(benchmark::State& state) {
  const asset::KinematicPlant plant{asset::KinematicOptions{}};
  VehicleState vehicle;
  vehicle.airspeed = 20;
  const Air air{{3, -2, 0}};
  for (auto _ : state) {
    plant.step(vehicle, FlightCommand{0.3, 20, 0}, air, 0.02);
    benchmark::DoNotOptimize(vehicle);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(plant_step);

// One aircraft, 50 Hz: plant, autopilot, fixes at 5 Hz and air data at 20 Hz.
void aircraft_step(benchmark::State& state) {
  const asset::KinematicPlant plant{asset::KinematicOptions{}};
  VehicleState vehicle;
  vehicle.p_N = {0, 0, -300};
  vehicle.v_N = {20, 0, 0};
  vehicle.airspeed = 20;
  NavEstimate start;
  start.p_N = vehicle.p_N;
  start.v_N = vehicle.v_N;
  autopilot::SimpleAutopilot autopilot({}, plant.limits(), start);
  const Air air{{3, -2, 0}};
  const bool path = state.range(0) != 0;
  if (path)
    autopilot.command({FollowPath{{{{0, 0}, 0, 1e7, 0.003}}}, 300});
  else
    autopilot.command({HoldCourse{1}, 300});
  std::int64_t tick = 0;
  for (auto _ : state) {
    const Time now = Time::from_ns(tick * 20'000'000);
    if (tick % 10 == 0) autopilot.sense(GnssFix{now, vehicle.p_N, vehicle.v_N, 0});
    if (tick % 2 == 0)
      autopilot.sense(AirDataSample{now, vehicle.airspeed, geo::yaw(vehicle.q_NB)});
    plant.step(vehicle, autopilot.control(now, 0.02), air, 0.02);
    ++tick;
  }
  benchmark::DoNotOptimize(vehicle);
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(aircraft_step)->ArgName("path")->Arg(0)->Arg(1);

// One decision of an agent beside a zone's border, where every course is tried.
void zone_guard(benchmark::State& state) {
  const std::vector<Zone> zones{
      {.area = geo::Ring{{-200, -300}, {300, -300}, {300, 300}, {-200, 300}}}};
  NavEstimate nav;
  nav.p_N = {-300, 0, -300};
  nav.v_N = {20, 0, 0};
  for (auto _ : state) {
    reasoning::ZoneAvoidance guard({}, FlightLimits{}, zones);
    benchmark::DoNotOptimize(guard.check(HoldCourse{0}, 0, nav));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(zone_guard);

}  // namespace
}  // namespace skein
