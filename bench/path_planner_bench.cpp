// SPDX-License-Identifier: Apache-2.0
// Paths around obstacles: cost of the scenes' paths after a time, without wind and in
// wind, repair after a new zone on the path, a fleet of 1,000 aircraft in each other's
// presence. Costs are in metres of air flown; `conflicts` of the fleet are pairs that a
// check by sampling finds in each other's rooms.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "skein/base/random.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/aa_star.h"
#include "skein/solve/path/fleet_plan.h"
#include "skein/solve/path/repair.h"

namespace skein::solve {
namespace {

const char* const kScenes[] = {"sparse10", "dense50", "wall"};
// Winds of the second argument, towards north and east [m/s]; the airspeed is 20 m/s.
const Vec2 kWinds[] = {Vec2(0, 0), Vec2(5, 0), Vec2(0, -5), Vec2(-10, 0), Vec2(7, 7)};

struct Scene {
  Airspace airspace;
  PathQuery query;
};

// The file counts x east, y north, angles from east counter-clockwise.
bool read_scene(std::int64_t index, Scene& scene) {
  const std::string file = std::string(SKEIN_SHARED_DATA) + "/planning/scenes.json";
  if (!std::filesystem::exists(file)) return false;
  std::ifstream in(file);
  const auto all = nlohmann::json::parse(in);
  const auto& s = all["scenes"][static_cast<std::size_t>(index)];
  const auto numbers = [](const nlohmann::json& j) {
    return j.get<std::vector<double>>();
  };
  const auto state = [&](const nlohmann::json& j) {
    const auto v = numbers(j);
    return FlightState{Vec3(v[1], v[0], -100), geo::kPi / 2 - v[2]};
  };
  for (const auto& c : s["circles"]) {
    const auto v = numbers(c);
    scene.airspace.zones.push_back({Disc{Vec2(v[1], v[0]), v[2]}});
  }
  scene.query.start = state(s["start"]);
  scene.query.goal = state(s["goal"]);
  scene.query.limits.airspeed = 20;
  scene.query.limits.turn_radius = s["turn_radius"].get<double>();
  scene.query.south_west = Vec2(0, 0);
  scene.query.north_east = Vec2::Constant(s["size"].get<double>());
  scene.query.airspace = &scene.airspace;
  return true;
}

std::string label_of(std::int64_t scene, std::int64_t wind) {
  const Vec2& w = kWinds[wind];
  return fmt::format("{} wind {:g},{:g}", kScenes[scene], w.x(), w.y());
}

void report(benchmark::State& state, const Scene& scene, const PlannedPath& path) {
  state.counters["cost_m"] = path.duration * scene.query.limits.airspeed;
  state.counters["bound_m"] = path.bound * scene.query.limits.airspeed;
  state.counters["states"] = static_cast<double>(path.expansions);
}

// Scene, wind, limit of time in ms; 0: the first path. Third: with routes or without.
void plan_scene(benchmark::State& state) {
  Scene scene;
  if (!read_scene(state.range(0), scene)) return state.SkipWithError("no scenes");
  scene.query.wind = kWinds[state.range(1)];
  scene.query.budget.expansions = 1'000'000'000;
  scene.query.budget.first = state.range(2) == 0;
  const double limit = static_cast<double>(state.range(2)) / 1000;
  const AaStar planner(AaStar::Options{.detours = state.range(3) != 0});
  PlannedPath path;
  for (auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    if (limit > 0)
      scene.query.budget.enough = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin)
                   .count() > limit;
      };
    path = planner.plan(scene.query);
  }
  report(state, scene, path);
  state.SetLabel(label_of(state.range(0), state.range(1)) +
                 (state.range(3) != 0 ? "" : " manoeuvres only"));
}
BENCHMARK(plan_scene)
    ->ArgNames({"scene", "wind", "ms", "ways"})
    ->ArgsProduct({{0, 1, 2}, {0, 1, 2, 3, 4}, {0, 50, 500}, {1}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(plan_scene)
    ->Name("plan_scene_by_manoeuvres")
    ->ArgNames({"scene", "wind", "ms", "ways"})
    ->ArgsProduct({{0, 1, 2}, {0}, {0, 50, 500}, {0}})
    ->Unit(benchmark::kMillisecond);

// Walls across the path, each with one gap; drawn.
Scene walls_of(std::int64_t count, double gap, std::uint64_t seed) {
  RandomStream draw(seed, 0, Purpose::kTest);
  Scene scene;
  constexpr double kApart = 300, kThick = 10, kAcross = 800;
  for (std::int64_t i = 0; i < count; ++i) {
    const double north = kApart * static_cast<double>(i + 1);
    const double middle = draw.uniform(-300, 300);
    const auto wall = [&](double west, double east) {
      scene.airspace.zones.push_back({geo::Ring{
          {north, west}, {north + kThick, west}, {north + kThick, east}, {north, east}}});
    };
    wall(-kAcross, middle - gap / 2);
    wall(middle + gap / 2, kAcross);
  }
  const double length = kApart * static_cast<double>(count + 1);
  scene.query.start = {Vec3(0, 0, -100), 0};
  scene.query.goal = {Vec3(length, 0, -100), 0};
  scene.query.limits.airspeed = 20;
  scene.query.limits.turn_radius = 60;
  scene.query.south_west = Vec2(-500, -kAcross);
  scene.query.north_east = Vec2(length + 500, kAcross);
  return scene;
}

// The first path through walls; gap in metres, seed, wind.
void first_path_through_walls(benchmark::State& state) {
  Scene scene = walls_of(5, static_cast<double>(state.range(0)),
                         static_cast<std::uint64_t>(state.range(1)));
  scene.query.airspace = &scene.airspace;
  scene.query.wind = kWinds[state.range(2)];
  scene.query.budget.first = true;
  scene.query.budget.expansions = 1'000'000;
  PlannedPath path;
  for (auto _ : state) path = AaStar().plan(scene.query);
  report(state, scene, path);
  state.SetLabel(std::string(name_of(path.outcome)));
}
BENCHMARK(first_path_through_walls)
    ->ArgNames({"gap", "seed", "wind"})
    ->ArgsProduct({{12, 40}, {1, 2, 3}, {0, 1, 2}})
    ->Unit(benchmark::kMillisecond);

// A zone of 70 m appears on the path; its place goes from early to late.
void repair_scene(benchmark::State& state) {
  Scene scene;
  if (!read_scene(state.range(0), scene)) return state.SkipWithError("no scenes");
  scene.query.wind = kWinds[state.range(1)];
  scene.query.budget.expansions = 20'000;
  const PlannedPath old = AaStar().plan(scene.query);
  const double part = static_cast<double>(state.range(2)) / 100;
  const double now = 0.05 * old.duration;
  const Vec3 at = model::moment_at(old.plan, part * old.duration).p_N;
  scene.airspace.zones.push_back({Disc{geo::horizontal(at), 70}});
  const model::FlightMoment m = model::moment_at(old.plan, now);
  scene.query.start = {m.p_N, m.heading};
  scene.query.start_time = now;
  RepairedPath path;
  for (auto _ : state) path = repair(old.plan, scene.query);
  report(state, scene, path.path);
  state.SetLabel(label_of(state.range(0), state.range(1)) + " " +
                 std::string(name_of(path.how)));
}
BENCHMARK(repair_scene)
    ->ArgNames({"scene", "wind", "percent"})
    ->ArgsProduct({{0, 1, 2}, {0, 1, 3}, {30, 50, 70}})
    ->Unit(benchmark::kMillisecond);

FleetQuery fleet_of(std::int64_t count, double latest_start) {
  FleetQuery fleet;
  RandomStream draw(2018, 0, Purpose::kTest);
  for (std::int64_t i = 0; i < count; ++i) {
    const auto place = [&] {
      return FlightState{
          Vec3(draw.uniform(0, 10'000), draw.uniform(0, 10'000), -draw.uniform(100, 400)),
          draw.uniform(-geo::kPi, geo::kPi)};
    };
    FleetMember m;
    m.who = EntityId{static_cast<std::uint32_t>(i)};
    m.start = place();
    m.goal = place();
    m.latest_start = latest_start;
    fleet.members.push_back(m);
  }
  fleet.common.south_west = Vec2(-500, -500);
  fleet.common.north_east = Vec2(10'500, 10'500);
  fleet.common.budget.expansions = 3000;
  return fleet;
}

// Whether at a time one is within the other's room, by samples 0.1 s apart.
bool in_room(const FleetQuery& fleet, const Vec3& p, const std::vector<Vec3>& other,
             std::size_t behind, std::size_t ahead, std::size_t now) {
  const std::size_t begin = now > behind ? now - behind : 0;
  const std::size_t end = std::min(other.size(), now + ahead + 1);
  for (std::size_t i = begin; i < end; ++i) {
    if (std::isnan(other[i].x())) continue;
    const Vec3 away = other[i] - p;
    if (std::abs(away.z()) <= fleet.height &&
        away.head<2>().norm() < fleet.zone.across - 0.1)
      return true;
  }
  return false;
}

// All pairs that come into one another's room.
std::int64_t conflicts(const FleetQuery& fleet, const FleetPlan& plan) {
  constexpr double kStep = 0.1;
  const Vec3 nowhere = Vec3::Constant(std::nan(""));
  std::vector<std::vector<Vec3>> tracks;
  for (const PlannedPath& path : plan.paths) {
    tracks.emplace_back();
    if (path.plan.empty()) continue;
    const double begin = model::start_of(path.plan), end = model::end_time_of(path.plan);
    for (double t = 0; t <= end; t += kStep)
      tracks.back().push_back(t < begin ? nowhere : model::moment_at(path.plan, t).p_N);
  }
  const auto behind = static_cast<std::size_t>(fleet.zone.behind / kStep);
  const auto ahead = static_cast<std::size_t>(fleet.zone.ahead / kStep);
  std::int64_t found = 0;
  for (std::size_t i = 0; i < tracks.size(); ++i)
    for (std::size_t k = 0; k < tracks.size(); ++k) {
      if (i == k) continue;
      for (std::size_t t = 0; t < tracks[i].size();) {
        const Vec3& p = tracks[i][t];
        const std::size_t last = tracks[k].empty() ? 0 : tracks[k].size() - 1;
        const Vec3& q = tracks[k].empty() ? nowhere : tracks[k][std::min(t, last)];
        // Two at 20 m/s close by 4 m a step; nothing can happen for a while where they
        // are far apart by more than they fly within the room's times.
        const double far = (p - q).norm() - 20.3 * 10 - fleet.zone.across;
        if (t <= last && far > 8) {
          t += static_cast<std::size_t>(far / 4.2);
          continue;
        }
        if (!std::isnan(p.x()) && in_room(fleet, p, tracks[k], behind, ahead, t)) {
          ++found;
          break;
        }
        ++t;
      }
    }
  return found;
}

void plan_fleet_of(benchmark::State& state) {
  const FleetQuery fleet = fleet_of(state.range(0), static_cast<double>(state.range(1)));
  FleetPlan plan;
  for (auto _ : state) plan = plan_fleet(fleet);
  double late = 0, longer = 0, states = 0;
  FleetPlan each_alone;  // as if there were no others: what is to be resolved
  for (std::size_t i = 0; i < plan.paths.size(); ++i) {
    const PlannedPath& p = plan.paths[i];
    states += static_cast<double>(p.expansions);
    FleetQuery alone = fleet;
    alone.members = {fleet.members[i]};
    each_alone.paths.push_back(plan_fleet(alone).paths.front());
    if (p.plan.empty()) continue;
    late += model::start_of(p.plan);
    longer += p.duration / each_alone.paths.back().duration - 1;
  }
  const double n = static_cast<double>(std::max<std::size_t>(1, plan.planned));
  state.counters["planned"] = static_cast<double>(plan.planned);
  state.counters["conflicts"] = static_cast<double>(conflicts(fleet, plan));
  state.counters["conflicts_alone"] = static_cast<double>(conflicts(fleet, each_alone));
  state.counters["late_s"] = late / n;
  state.counters["longer_percent"] = 100 * longer / n;
  state.counters["states"] = states;
}
BENCHMARK(plan_fleet_of)
    ->ArgNames({"aircraft", "latest_s"})
    ->Args({100, 600})
    ->Args({1000, 600})
    ->Args({1000, 0})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
}  // namespace skein::solve
