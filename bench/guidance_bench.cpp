// SPDX-License-Identifier: Apache-2.0
// Cost of guidance: one step of each command for fixed wings and multirotors, and the
// `path` autopilot on a path of ten elements. The vehicle moves as commanded, without
// lags, so that what is timed is guidance.

#include <benchmark/benchmark.h>

#include <cmath>

#include "skein/data/vehicle/air.h"
#include "skein/layer/autopilot/guidance/fixed_wing_guidance.h"
#include "skein/layer/autopilot/guidance/multirotor_guidance.h"
#include "skein/layer/autopilot/guidance/unflyable.h"
#include "skein/layer/autopilot/simple_autopilot.h"
#include "skein/model/path/path_geometry.h"

namespace skein {
namespace {

constexpr double kStep = 0.01;  // [s]
const FlightLimits kLimits{15, 40, 3, 11, 20, 3};

// Ten elements: straights of 120 m and half turns of 80 m, left and right in turn.
Path ten_elements() {
  Path path;
  model::Pose at{{0, 0}, 0};
  for (int i = 0; i < 10; ++i) {
    const double side = i % 4 == 1 ? 1 : -1;
    const bool turn = i % 2 == 1;
    path.push_back(
        {at.position, at.course, turn ? geo::kPi * 80 : 120, turn ? side / 80 : 0});
    at = model::end_of(path.back());
  }
  return path;
}

Plan plan_of(const Path& path, double speed, double begin) {
  Plan plan;
  for (double s = 0; s < model::length(path); s += 30) {
    const model::Pose at = model::pose_at(path, s);
    const Vec2 v = speed * geo::unit(at.course);
    plan.push_back({Time::from_seconds(begin + s / speed),
                    {at.position.x(), at.position.y(), -100},
                    {v.x(), v.y(), 0}});
  }
  return plan;
}

FlyWaypoints square(double side) {
  return {{{{side, 0}, 100}, {{side, side}, 100}, {{0, side}, 100}, {{0, 0}, 100}}, 1000};
}

enum Kind { kPath, kPlan, kWaypoints, kCircle };

autopilot::NavState start(double heading) {
  autopilot::NavState nav;
  nav.p_N = {0, 0, -100};
  nav.q_NB = geo::from_euler({0, 0, heading});
  nav.v_N = {15, 0, 0};
  nav.airspeed = 15;
  return nav;
}

// Moves a point on by the lateral acceleration, without angle functions.
void move(autopilot::NavState& nav, double lateral) {
  nav.time += Time::from_ns(10'000'000);
  Vec2 v = nav.v_N.head<2>();
  v += kStep / v.norm() * lateral * geo::turned_right(v);
  nav.v_N.head<2>() = v * (15 / v.norm());
  nav.p_N += kStep * nav.v_N;
}

AutopilotCommand command(Kind kind, double speed, const autopilot::NavState& nav) {
  AutopilotCommand out;
  out.altitude_msl = 100;
  if (kind == kPath) out.guidance = FollowPath{ten_elements()};
  if (kind == kPlan)
    out.guidance = FollowPlan{plan_of(ten_elements(), speed, nav.time.seconds())};
  if (kind == kWaypoints) out.guidance = square(400);
  if (kind == kCircle) out.guidance = Circle{{0, 100}, 100, true};
  return out;
}

void fixed_wing(benchmark::State& state) {
  autopilot::FixedWingGuidanceOptions options;
  options.lateral.law = static_cast<autopilot::LateralLaw>(state.range(1));
  autopilot::FixedWingGuidance guidance(options, kLimits, {0, 0, -100});
  autopilot::NavState nav = start(0);
  const auto begin = [&] {
    const Time time = nav.time;
    nav = start(0);
    nav.time = time;
    guidance.forget(autopilot::motion_of(nav));
    const auto refused = guidance.command(
        command(static_cast<Kind>(state.range(0)), 15, nav), autopilot::motion_of(nav));
    if (refused) state.SkipWithError(refused->c_str());
  };
  begin();
  for (auto _ : state) {
    const auto demand = guidance.step(autopilot::motion_of(nav), kStep);
    move(nav, demand.lateral_acceleration);
    if (guidance.status().done && state.range(0) != kCircle) begin();
  }
  benchmark::DoNotOptimize(nav);
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(fixed_wing)
    ->ArgNames({"command", "law"})
    ->ArgsProduct({{kPath, kPlan, kWaypoints, kCircle}, {0, 1, 2}});

// What `fixed_wing` and `multirotor` spend outside guidance.
void move_alone(benchmark::State& state) {
  autopilot::NavState nav = start(0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(autopilot::motion_of(nav).airspeed);
    move(nav, 1);
  }
  benchmark::DoNotOptimize(nav);
}
BENCHMARK(move_alone);

void multirotor(benchmark::State& state) {
  MultirotorAirframe airframe;
  airframe.cruise = 10;
  airframe.fastest = 18;
  airframe.climb_rate = airframe.sink_rate = 3;
  autopilot::MultirotorGuidance guidance({}, airframe, {0, 0, -100});
  autopilot::NavState nav = start(0);
  const auto begin = [&] {
    const Time time = nav.time;
    nav = start(0);
    nav.time = time;
    guidance.command({HoldCourse{0}, 100, {}}, nav);
    guidance.command(command(static_cast<Kind>(state.range(0)), 8, nav), nav);
  };
  begin();
  for (auto _ : state) {
    const auto demand = guidance.step(nav, kStep);
    nav.time += Time::from_ns(10'000'000);
    nav.p_N.head<2>() = demand.position;
    nav.v_N.head<2>() = demand.velocity;
    if (guidance.status().done) begin();
  }
  benchmark::DoNotOptimize(nav);
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(multirotor)->ArgName("command")->DenseRange(kPath, kCircle);

// The `path` autopilot alone at 100 Hz, with a plant that banks as commanded.
void path_autopilot(benchmark::State& state) {
  NavEstimate at;
  at.p_N = {0, 0, -100};
  at.v_N = {20, 0, 0};
  const FlightLimits limits{20, 60, 3, 15, 25, 3};
  autopilot::SimpleAutopilot autopilot({}, limits, at);
  const auto begin = [&] {
    autopilot.command({HoldCourse{0}, 100, {}});
    autopilot.command({FollowPath{ten_elements()}, 100, {}});
  };
  begin();
  Vec3 p = at.p_N;
  double heading = 0;
  std::int64_t tick = 0;
  for (auto _ : state) {
    const Time now = Time::from_ns(tick * 10'000'000);
    const Vec2 v = 20 * geo::unit(heading);
    if (tick % 20 == 0) autopilot.sense(GnssFix{now, p, {v.x(), v.y(), 0}, 0});
    if (tick % 5 == 0) autopilot.sense(AirDataSample{now, 20, heading});
    const auto control = std::get<FlightCommand>(autopilot.control(now, kStep));
    heading = geo::wrap_pi(heading + kStep * kGravity * std::tan(control.roll) / 20);
    p.head<2>() += kStep * v;
    if (autopilot.status().done) {
      p = at.p_N;
      heading = 0;
      autopilot.sense(GnssFix{now, p, {20, 0, 0}, 0});
      begin();
    }
    ++tick;
  }
  benchmark::DoNotOptimize(p);
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(path_autopilot);

// Judging a plan of 44 points.
void judge_plan(benchmark::State& state) {
  const AutopilotCommand plan = command(kPlan, 15, start(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(autopilot::unflyable(plan, kLimits, {1, 0}));
}
BENCHMARK(judge_plan);

}  // namespace
}  // namespace skein
