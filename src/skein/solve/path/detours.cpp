// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/detours.h"

#include <algorithm>
#include <utility>

#include "skein/model/path/climb_profile.h"
#include "skein/model/path/flight_plan.h"

namespace skein::solve {
namespace {

void add_rounds(const Zone& zone, const DetourMargins& margins,
                std::vector<CircularObstacle>& obstacles) {
  if (const auto* disc = std::get_if<Disc>(&zone.area)) {
    obstacles.push_back({disc->centre, disc->radius + margins.disc});
    return;
  }
  const auto& ring = std::get<geo::Ring>(zone.area);
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = ring[i] - ring[(i + n - 1) % n];
    const Vec2 after = ring[(i + 1) % n] - ring[i];
    if (geo::cross(before, after) > 0)
      obstacles.push_back({ring[i], margins.corner, true});
  }
}

// The pieces of a route over ground, as if flown without wind, in time and altitude.
FlightPlan geometry_of(const Detour& detour, const GroundSpeed& speed,
                       const DetourRequest& request) {
  FlightPlan plan;
  FlightElement e;
  e.start = request.start_time;
  const double climb =
      detour.time > 0 ? (request.goal_altitude - request.start_altitude) / detour.time
                      : 0;
  const auto add = [&](const Vec2& p, double course, double length, double turn,
                       double time) {
    if (time <= 0) return;
    const double z = request.start_altitude + climb * (e.start - request.start_time);
    e.p_N = {p.x(), p.y(), -z};
    e.heading = course;
    e.duration = time;
    e.airspeed = length / time;
    e.turn_rate = turn / time;
    e.climb_rate = climb;
    plan.push_back(e);
    e.start += time;
  };
  for (std::size_t i = 0; i < detour.arcs.size(); ++i) {
    const Detour::Arc& arc = detour.arcs[i];
    const double r = arc.obstacle.radius, turn = arc.side * arc.turned;
    const auto at = [&](const Detour::Arc& a, double course) -> Vec2 {
      return a.obstacle.centre -
             a.side * a.obstacle.radius * geo::turned_right(geo::unit(course));
    };
    add(at(arc, arc.course), arc.course, r * arc.turned, turn,
        speed.arc(r, arc.course, turn));
    if (i + 1 == detour.arcs.size()) break;
    const Detour::Arc& next = detour.arcs[i + 1];
    const Vec2 from = at(arc, next.course), to = at(next, next.course);
    add(from, next.course, (to - from).norm(), 0, speed.straight(to - from));
  }
  return plan;
}

}  // namespace

Detours detours_around(const std::vector<Zone>& zones, const PathQuery& query,
                       const GroundSpeed& speed, const DetourRequest& request,
                       const DetourMargins& margins, const PlanningBudget& budget) {
  Airspace all;
  all.zones = zones;
  PathQuery alone = query;
  alone.airspace = &all;
  const AirspaceMap map(alone);
  Airspace some;
  std::vector<bool> taken(zones.size(), false);
  std::vector<CircularObstacle> obstacles;
  alone.airspace = &some;
  std::int64_t expansions = 0;
  while (true) {
    PlanningBudget rest = budget;
    rest.expansions -= expansions;
    rest.first_expansions -= expansions;
    Detours found =
        find_tangent_paths(AirspaceMap(alone), obstacles, speed, request, rest);
    found.expansions += expansions;
    expansions = found.expansions;
    bool more = false;
    for (const Detour& detour : found.detours)
      for (const std::size_t i : map.zones_met(geometry_of(detour, speed, request))) {
        if (taken[i]) continue;
        taken[i] = more = true;
        some.zones.push_back(zones[i]);
        add_rounds(zones[i], margins, obstacles);
      }
    if (!more) return found;
    if (expansions >= budget.expansions || budget.ends_at(expansions)) {
      found.detours.clear();
      found.complete = false;
      return found;
    }
  }
}

FlightPlan fly_detour(const Detour& detour, const PathQuery& query) {
  FlightPlan plan;
  FlightElement e;
  e.start = query.start_time;
  e.p_N = query.start.p_N;
  e.heading = query.start.heading;
  e.airspeed = query.limits.airspeed;
  const auto add = [&](double duration, double turn_rate) {
    if (duration <= 0) return;
    e.duration = duration;
    e.turn_rate = turn_rate;
    plan.push_back(e);
    const model::FlightMoment end = model::end_of(e);
    e.start += duration;
    e.p_N = end.p_N;
    e.heading = end.heading;
  };
  for (std::size_t i = 0; i < detour.arcs.size(); ++i) {
    const Detour::Arc& arc = detour.arcs[i];
    const double r = arc.obstacle.radius;
    if (r > 0) add(r * arc.turned / e.airspeed, arc.side * e.airspeed / r);
    if (i + 1 == detour.arcs.size()) break;
    const Detour::Arc& next = detour.arcs[i + 1];
    const Vec2 out = geo::turned_right(geo::unit(next.course));
    const Vec2 straight = next.obstacle.centre - next.side * next.obstacle.radius * out -
                          arc.obstacle.centre + arc.side * r * out;
    add(straight.norm() / e.airspeed, 0);
  }
  const double climb = query.start.p_N.z() - query.goal.p_N.z();
  return model::climbing(
      plan, query.start.p_N.z(),
      model::even_climb(climb, model::duration(plan), query.limits.climb_acceleration));
}

}  // namespace skein::solve
