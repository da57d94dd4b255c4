#include "skein/layer/reasoning/planning/search/ways.h"

#include <algorithm>
#include <utility>

#include "skein/model/path/flight_plan.h"

namespace skein::planning {
namespace {

void add_rounds(const Zone& zone, const WayMargins& margins, std::vector<Round>& rounds) {
  if (const auto* disc = std::get_if<Disc>(&zone.area)) {
    rounds.push_back({disc->centre, disc->radius + margins.disc});
    return;
  }
  const auto& ring = std::get<geo::Ring>(zone.area);
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = ring[i] - ring[(i + n - 1) % n];
    const Vec2 after = ring[(i + 1) % n] - ring[i];
    if (geo::cross(before, after) > 0) rounds.push_back({ring[i], margins.corner, true});
  }
}

// The pieces of a way over ground, as if flown without wind, in time and altitude.
FlightPlan geometry_of(const Way& way, const GroundSpeed& speed,
                       const WayRequest& request) {
  FlightPlan plan;
  FlightElement e;
  e.start = request.start_time;
  const double climb =
      way.time > 0 ? (request.goal_altitude - request.start_altitude) / way.time : 0;
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
  for (std::size_t i = 0; i < way.arcs.size(); ++i) {
    const Way::Arc& arc = way.arcs[i];
    const double r = arc.round.radius, turn = arc.side * arc.turned;
    const auto at = [&](const Way::Arc& a, double course) -> Vec2 {
      return a.round.centre -
             a.side * a.round.radius * geo::turned_right(geo::unit(course));
    };
    add(at(arc, arc.course), arc.course, r * arc.turned, turn,
        speed.arc(r, arc.course, turn));
    if (i + 1 == way.arcs.size()) break;
    const Way::Arc& next = way.arcs[i + 1];
    const Vec2 from = at(arc, next.course), to = at(next, next.course);
    add(from, next.course, (to - from).norm(), 0, speed.straight(to - from));
  }
  return plan;
}

}  // namespace

Ways ways_around(const std::vector<Zone>& zones, const PathQuery& query,
                 const GroundSpeed& speed, const WayRequest& request,
                 const WayMargins& margins, const PlanningBudget& budget) {
  Airspace all;
  all.zones = zones;
  PathQuery alone = query;
  alone.airspace = &all;
  const AirspaceMap map(alone);
  Airspace some;
  std::vector<bool> taken(zones.size(), false);
  std::vector<Round> rounds;
  alone.airspace = &some;
  std::int64_t states = 0;
  while (true) {
    PlanningBudget rest = budget;
    rest.states -= states;
    rest.first_states -= states;
    Ways found = find_ways(AirspaceMap(alone), rounds, speed, request, rest);
    found.states += states;
    states = found.states;
    bool more = false;
    for (const Way& way : found.ways)
      for (const std::size_t i : map.zones_met(geometry_of(way, speed, request))) {
        if (taken[i]) continue;
        taken[i] = more = true;
        some.zones.push_back(zones[i]);
        add_rounds(zones[i], margins, rounds);
      }
    if (!more) return found;
    if (states >= budget.states || budget.ends_at(states)) {
      found.ways.clear();
      found.complete = false;
      return found;
    }
  }
}

FlightPlan fly_way(const Way& way, const PathQuery& query) {
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
  for (std::size_t i = 0; i < way.arcs.size(); ++i) {
    const Way::Arc& arc = way.arcs[i];
    const double r = arc.round.radius;
    if (r > 0) add(r * arc.turned / e.airspeed, arc.side * e.airspeed / r);
    if (i + 1 == way.arcs.size()) break;
    const Way::Arc& next = way.arcs[i + 1];
    const Vec2 out = geo::turned_right(geo::unit(next.course));
    const Vec2 straight = next.round.centre - next.side * next.round.radius * out -
                          arc.round.centre + arc.side * r * out;
    add(straight.norm() / e.airspeed, 0);
  }
  const double whole = model::duration(plan);
  const double climb = whole > 0 ? (query.start.p_N.z() - query.goal.p_N.z()) / whole : 0;
  for (FlightElement& piece : plan) {
    piece.climb_rate = climb;
    piece.p_N.z() = query.start.p_N.z() - climb * (piece.start - query.start_time);
  }
  return plan;
}

}  // namespace skein::planning
