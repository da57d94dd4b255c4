// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/trajectory.h"

namespace skein::solve {
namespace {

// How far beside a conflict waypoints are tried: in steps that grow, from the turn radius
// times the first.
constexpr double kFirstOffset = 0.4, kOffsetGrowth = 1.7;
constexpr int kOffsets = 7;
// Above and below [m].
constexpr double kFirstUp = 12, kUpGrowth = 1.8;
constexpr int kUps = 4;

// The cost of a trajectory: until when it is free, and how long it takes.
struct Cost {
  Trajectory trajectory;
  double free_until = 0;
  bool free = false;
  std::optional<Conflict> conflict = std::nullopt;

  bool better_than(const Cost& other) const {
    if (free != other.free) return free;
    if (free) return trajectory.duration() < other.trajectory.duration();
    return free_until > other.free_until;
  }
};

Cost cost(Trajectory trajectory, const AirspaceMap& map) {
  Cost out;
  out.conflict = map.first_meeting(to_flight_plan(trajectory, map.query()));
  out.free = !out.conflict;
  out.free_until = out.free ? trajectory.times.back() : out.conflict->time;
  out.trajectory = std::move(trajectory);
  return out;
}

// The waypoints that are tried in place of a conflict.
std::vector<FlightState> beside(const Conflict& conflict, const FlightState& at,
                                double turn_radius, bool vertical) {
  std::vector<FlightState> states;
  // The middle of the obstacle is some distance on.
  const auto add = [&](double along, double across, double up) {
    FlightState s = at;
    s.p_N = conflict.p_N;
    const Vec2 u = geo::unit(at.heading);
    s.p_N.head<2>() += along * u + across * geo::turned_right(u);
    s.p_N.z() -= up;
    states.push_back(s);
  };
  double offset = kFirstOffset * turn_radius;
  for (int i = 0; i < kOffsets; ++i, offset *= kOffsetGrowth)
    for (const double side : {1.0, -1.0}) add(0.7 * offset, side * offset, 0);
  if (!vertical) return states;
  double up = kFirstUp;
  for (int i = 0; i < kUps; ++i, up *= kUpGrowth)
    for (const double side : {1.0, -1.0}) add(0, 0, side * up);
  return states;
}

}  // namespace

std::optional<Trajectory> swerve(Trajectory trajectory, const AirspaceMap& map,
                                 SearchBudget& budget, int max) {
  const PathQuery& query = map.query();
  Cost now = cost(std::move(trajectory), map);
  for (int i = 0; i < max && !now.free && !budget.ended(); ++i) {
    const double time = now.conflict->time;
    const auto& times = now.trajectory.times;
    const auto after = std::upper_bound(times.begin() + 1, times.end() - 1, time);
    const FlightPlan plan = to_flight_plan(now.trajectory, query);
    const FlightState at{now.conflict->p_N, model::moment_at(plan, time).heading};
    std::optional<Cost> best;
    for (const FlightState& s : beside(*now.conflict, at, query.limits.turn_radius,
                                       query.limits.climb_rate > 0)) {
      if (!budget.spend(2)) break;
      std::vector<Waypoint> waypoints = now.trajectory.waypoints;
      waypoints.insert(waypoints.begin() + (after - times.begin()), Waypoint{s});
      std::optional<Trajectory> next = make_trajectory(std::move(waypoints), query);
      if (!next ||
          (best && best->free && next->duration() >= best->trajectory.duration()))
        continue;
      Cost trial = cost(std::move(*next), map);
      if (!best || trial.better_than(*best)) best = std::move(trial);
    }
    if (!best || (!best->free && best->free_until <= now.free_until)) return std::nullopt;
    now = std::move(*best);
  }
  if (!now.free) return std::nullopt;
  return std::move(now.trajectory);
}

}  // namespace skein::solve
