// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/query_check.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "skein/geo/self_crossing.h"

namespace skein::solve {
namespace {

constexpr double kFurthest = 1e8;    // [m]
constexpr double kMaxHeading = 1e6;  // [rad]
constexpr double kMaxTime = 1e12;    // [s]

struct Range {
  double min, max;
};

PlannedPath answer(PlanningOutcome outcome, std::string reason) {
  PlannedPath out;
  out.outcome = outcome;
  out.reason = std::move(reason);
  return out;
}

std::string problem_of_ring(const geo::Ring& ring) {
  if (ring.size() < 3)
    return fmt::format("has {} corners, of which there must be 3 at least", ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (!ring[i].allFinite()) return fmt::format("has a corner {} that is no place", i);
  if (const auto crossing = geo::self_crossing(ring))
    return fmt::format(
        "crosses itself at {:.1f} m north, {:.1f} m east (edges {} and {})",
        crossing->point.x(), crossing->point.y(), crossing->first, crossing->second);
  const double area = geo::signed_area(ring);
  if (area == 0) return "has no area";
  if (area < 0) return "runs counter-clockwise on the map; reverse its corners";
  return "";
}

std::string problem_of(const Zone& zone) {
  if (const auto* disc = std::get_if<Disc>(&zone.area)) {
    if (!disc->centre.allFinite()) return "has no centre";
    if (!std::isfinite(disc->radius) || disc->radius <= 0)
      return fmt::format("has the radius {} m, which must be above 0", disc->radius);
  } else if (std::string p = problem_of_ring(std::get<geo::Ring>(zone.area));
             !p.empty()) {
    return p;
  }
  if (!(zone.floor_msl <= zone.ceiling_msl))
    return fmt::format("has its floor of {} m above its ceiling of {} m", zone.floor_msl,
                       zone.ceiling_msl);
  if (!(zone.from <= zone.until))
    return fmt::format("ends at {} s before it begins at {} s", zone.until, zone.from);
  return "";
}

std::string problem_of(const MovingObstacle& m) {
  const bool finite = m.p_N.allFinite() && m.v_N.allFinite() && std::isfinite(m.time) &&
                      std::isfinite(m.radius) && std::isfinite(m.height);
  if (!finite) return "has something that is no number";
  if (m.radius <= 0 || m.height < 0) return "must have a radius above 0 and a height";
  if (!(m.from <= m.until)) return "ends before it begins";
  return "";
}

std::string problem_of(const PlannedFlight& f) {
  const bool room = std::isfinite(f.zone.ahead) && std::isfinite(f.zone.behind) &&
                    std::isfinite(f.zone.across) && std::isfinite(f.height) &&
                    f.zone.ahead >= 0 && f.zone.behind >= 0 && f.zone.across > 0 &&
                    f.height >= 0;
  if (!room) return "has a room that is not finite and above 0";
  for (std::size_t i = 0; i < f.plan.size(); ++i) {
    const FlightElement& e = f.plan[i];
    const bool finite = std::isfinite(e.start) && std::isfinite(e.duration) &&
                        e.p_N.allFinite() && std::isfinite(e.heading) &&
                        std::isfinite(e.airspeed) && std::isfinite(e.turn_rate) &&
                        std::isfinite(e.climb_rate) &&
                        std::isfinite(e.climb_acceleration) && e.wind.allFinite();
    if (!finite || e.duration < 0)
      return fmt::format("has an element {} that is not finite or ends before it begins",
                         i);
  }
  return "";
}

std::string problem_of(const Airspace& airspace) {
  std::size_t i = 0;
  for (const Zone& zone : airspace.zones) {
    const std::string p = problem_of(zone);
    if (!p.empty())
      return zone.name.empty() ? fmt::format("zone {} {}", i, p)
                               : fmt::format("zone {} '{}' {}", i, zone.name, p);
    ++i;
  }
  i = 0;
  for (const MovingObstacle& mover : airspace.movers) {
    const std::string p = problem_of(mover);
    if (!p.empty()) return fmt::format("moving obstacle {} {}", i, p);
    ++i;
  }
  i = 0;
  for (const PlannedFlight& flight : airspace.flights) {
    const std::string p = problem_of(flight);
    if (!p.empty()) return fmt::format("planned flight {} {}", i, p);
    ++i;
  }
  return "";
}

// Whether a place is one: finite and not further away than the earth's surface goes.
bool is_place(const Vec3& p) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= kFurthest;
}

// A value out of its range, in words; empty when it is in it.
std::string out_of(const Range& range, double x, std::string_view name) {
  if (x >= range.min && x <= range.max) return "";
  return fmt::format("the {} is {:g}; it must be from {:g} to {:g}", name, x, range.min,
                     range.max);
}

std::string problem_of_limits(const PathQuery& q) {
  const auto sound = [](const FlightState& s) {
    return is_place(s.p_N) && std::abs(s.heading) <= kMaxHeading;
  };
  if (!sound(q.start)) return "the start is not a place with a heading";
  if (!sound(q.goal)) return "the goal is not a place with a heading";
  if (!(std::abs(q.start_time) <= kMaxTime)) return "the start's time is not a time";
  if (!q.wind.allFinite()) return "the wind is not finite";
  const std::string limits[] = {
      out_of({0.01, 1e4}, q.limits.airspeed, "airspeed in m/s"),
      out_of({0.01, 1e6}, q.limits.turn_radius, "turn radius in m"),
      out_of({1e-3, 1e4}, q.limits.climb_rate, "climb rate in m/s"),
      out_of({1e-3, 1e4}, q.limits.sink_rate, "sink rate in m/s"),
      out_of({0, 1e4}, q.limits.climb_acceleration, "vertical acceleration in m/s^2"),
      out_of({0, 1e5}, q.ground_clearance, "ground clearance in m")};
  for (const std::string& problem : limits)
    if (!problem.empty()) return problem;
  if (q.budget.expansions <= 0)
    return fmt::format("the budget is {} expansions; it must be above 0",
                       q.budget.expansions);
  if (!(q.south_west.x() < q.north_east.x() && q.south_west.y() < q.north_east.y()))
    return "the map's corner in the south-west is not south-west of the other one";
  return "";
}

std::string place(const Vec3& p) {
  return fmt::format("{:.1f} m north, {:.1f} m east, {:.1f} m altitude", p.x(), p.y(),
                     0.0 - p.z());
}

PlannedPath blocked(PlanningOutcome outcome, const AirspaceMap& map,
                    const FlightState& state, double time, const Conflict& conflict) {
  const bool start = outcome == PlanningOutcome::kStartBlocked;
  PlannedPath out = answer(
      outcome, fmt::format("the {} is {}", start ? "start" : "goal", conflict.what));
  if (const auto p = map.nearest_free(state.p_N, time)) {
    out.alternative = FlightState{*p, state.heading};
    out.reason += "; the nearest place found that is not is " + place(*p);
  }
  return out;
}

}  // namespace

std::optional<PlannedPath> refuse_airspace(const PathQuery& query) {
  if (query.airspace == nullptr) return std::nullopt;
  std::string problem = problem_of(*query.airspace);
  if (problem.empty()) return std::nullopt;
  return answer(PlanningOutcome::kBadQuery, std::move(problem));
}

std::optional<PlannedPath> refuse_flight(const PathQuery& query) {
  if (std::string p = problem_of_limits(query); !p.empty())
    return answer(PlanningOutcome::kBadQuery, std::move(p));
  if (query.wind.norm() >= query.limits.airspeed)
    return answer(
        PlanningOutcome::kWindTooStrong,
        fmt::format("the wind of {:.2f} m/s is not below the airspeed of {:.2f} "
                    "m/s: places upwind cannot be reached",
                    query.wind.norm(), query.limits.airspeed));
  const auto outside = [&](const FlightState& s) {
    const Vec2 p = geo::horizontal(s.p_N);
    return (p.array() < query.south_west.array()).any() ||
           (p.array() > query.north_east.array()).any();
  };
  for (const FlightState* s : {&query.start, &query.goal}) {
    if (!outside(*s)) continue;
    PlannedPath out = answer(
        PlanningOutcome::kOutsideMap,
        fmt::format(
            "the {} at {} is outside of the map, {:.1f} to {:.1f} m north, {:.1f} "
            "to {:.1f} m east",
            s == &query.start ? "start" : "goal", place(s->p_N), query.south_west.x(),
            query.north_east.x(), query.south_west.y(), query.north_east.y()));
    FlightState inside = *s;
    inside.p_N.head<2>() =
        geo::horizontal(s->p_N).cwiseMax(query.south_west).cwiseMin(query.north_east);
    out.alternative = inside;
    return out;
  }
  return std::nullopt;
}

std::optional<PlannedPath> refuse_blocked(const AirspaceMap& map,
                                          double earliest_arrival) {
  const PathQuery& query = map.query();
  if (const auto c = map.conflict_at(query.start.p_N, query.start_time))
    return blocked(PlanningOutcome::kStartBlocked, map, query.start, query.start_time,
                   *c);
  if (map.free_from(query.goal.p_N, earliest_arrival)) return std::nullopt;
  const auto c = map.conflict_at(query.goal.p_N, earliest_arrival);
  // Free on arrival at the latest moment before it is blocked for good, or not at all.
  if (!c) return std::nullopt;
  return blocked(PlanningOutcome::kGoalBlocked, map, query.goal, earliest_arrival, *c);
}

}  // namespace skein::solve
