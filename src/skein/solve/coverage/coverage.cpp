// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/coverage/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "skein/data/airspace/airspace.h"
#include "skein/geo/clip.h"
#include "skein/model/path/flight_plan.h"
#include "skein/model/path/wind_triangle.h"
#include "skein/solve/coverage/coverage_check.h"
#include "skein/solve/coverage/gap_lines.h"
#include "skein/solve/coverage/sweep_bearings.h"
#include "skein/solve/coverage/sweep_search.h"
#include "skein/solve/coverage/zone_lines.h"
#include "skein/solve/path/join.h"

namespace skein::solve {
namespace {

// For each connection around zones, and for one that is hard to find.
constexpr std::int64_t kExpansions[] = {3000, 100'000};
constexpr double kBesideZones = 0.01;  // of lines to zones, against rounding [m]

SweepTask task_of(const CoverageQuery& query, geo::Region area,
                  std::vector<geo::Ring> zones) {
  SweepTask task;
  task.area = std::move(area);
  task.spacing = query.swath * (1 - query.overlap);
  task.overshoot = query.overshoot;
  task.air = motion_of(query.limits, query.wind);
  const double turn = model::ground_turn_radius(query.limits.turn_radius,
                                                query.limits.airspeed, query.wind.norm());
  // Shorter gaps are not worth leaving the line.
  task.joined = turn;
  task.zones = ZoneRings(std::move(zones));
  task.watch = query.watch;
  task.room = {query.zone_distance + kBesideZones, turn};
  for (const CoverageAircraft& a : query.aircraft) {
    RouteEnds ends;
    if (a.start) ends.start = pose_of(*a.start);
    if (a.end) ends.end = pose_of(*a.end);
    task.ends.push_back(ends);
  }
  return task;
}

// Adds a connection to the plan, around zones where that is needed and possible.
void add_connection(const CoverageQuery& query, const FlightState& from,
                    const FlightState& to, FlightPlan& plan) {
  const double start = plan.empty() ? query.start_time : model::end_time_of(plan);
  FlightPlan connection = join(from, to, query.limits, query.wind, start);
  if (query.planner != nullptr && time_within(connection, query.zones) > 0) {
    Airspace airspace;
    airspace.zones = query.zones;
    PathQuery ask;
    ask.start = from;
    ask.goal = to;
    ask.start_time = start;
    ask.limits = query.limits;
    ask.wind = query.wind;
    ask.airspace = &airspace;
    for (const std::int64_t expansions : kExpansions) {
      ask.budget.expansions = expansions;
      PlannedPath path = query.planner->plan(ask);
      if (path.plan.empty()) continue;
      connection = std::move(path.plan);
      break;
    }
  }
  plan.insert(plan.end(), connection.begin(), connection.end());
}

FlightState state_of(const model::Pose& pose, double down) {
  return {{pose.position.x(), pose.position.y(), down}, pose.course};
}

FlightPlan plan_of(const CoverageQuery& query, const SweepTask& task,
                   const LineCosts& costs, const CoverageAircraft& aircraft,
                   const Route& route) {
  FlightPlan plan;
  if (route.empty()) return plan;
  const double down = -query.altitude_msl;
  std::optional<FlightState> here = aircraft.start;
  for (const int visit : route) {
    const FlightState entry = state_of(costs.entry(visit), down);
    if (here) add_connection(query, *here, entry, plan);
    const double start = plan.empty() ? query.start_time : model::end_time_of(plan);
    const FlightState exit = state_of(costs.exit(visit), down);
    plan.push_back(straight(geo::horizontal(entry.p_N), geo::horizontal(exit.p_N), down,
                            task.air, start));
    here = exit;
  }
  if (aircraft.end) add_connection(query, *here, *aircraft.end, plan);
  return plan;
}

// Share of the area that lies beside lines that are flown.
double share_beside(const geo::Region& area, const std::vector<SweepLine>& lines,
                    double swath) {
  const geo::Region seen = beside(lines, swath / 2);
  return std::min(
      1.0, geo::shared_area(area, seen, geo::FillRule::kNonZero) / geo::area(area));
}

CoverageResult described(const CoverageQuery& query, const SweepTask& task,
                         const Sweep& sweep) {
  CoverageResult result;
  LineCosts costs(sweep.lines, task.air, task.ends);
  for (std::size_t a = 0; a < query.aircraft.size(); ++a) {
    result.plans.push_back(
        plan_of(query, task, costs, query.aircraft[a], sweep.routes[a]));
    const FlightPlan& plan = result.plans.back();
    result.times.push_back(model::duration(plan));
    result.longest = std::max(result.longest, result.times.back());
    result.total += result.times.back();
    result.in_zones += time_within(plan, query.zones);
    std::vector<Vec2>& ends = result.line_ends.emplace_back();
    for (const int visit : sweep.routes[a]) {
      result.on_lines += costs.along(visit);
      ends.push_back(costs.entry(visit).position);
      ends.push_back(costs.exit(visit).position);
    }
  }
  result.bearing = half_turn(sweep.bearing);
  result.lines = static_cast<int>(sweep.lines.size());
  result.area = geo::area(task.area);
  result.covered_share = share_beside(task.area, sweep.lines, query.swath);
  result.stopped = query.watch.stopped();
  result.outcome = CoverageOutcome::kPlanned;
  if (result.in_zones > 0) {
    result.outcome = CoverageOutcome::kZoneInTheWay;
    result.reason = fmt::format(
        "{:.1f} s of connections lie in zones{}", result.in_zones,
        query.planner == nullptr ? "; a path planner would lead around them" : "");
  }
  return result;
}

}  // namespace

std::string_view name_of(CoverageOutcome outcome) {
  constexpr std::string_view kNames[] = {
      "planned",   "zone-in-the-way", "nothing-to-cover", "bad-area",       "bad-zone",
      "bad-swath", "bad-aircraft",    "wind-too-strong",  "too-many-lines", "blocked"};
  return kNames[static_cast<std::size_t>(outcome)];
}

CoverageResult plan_coverage(const CoverageQuery& query) {
  CoverageResult result;
  if (auto bad = check(query)) return std::move(*bad);
  std::vector<geo::Ring> zones;
  for (const Zone& zone : zones_that_count(query)) zones.push_back(outline(zone));
  geo::Region area = area_to_cover(query, zones);
  if (geo::area(area) < kMinArea) {
    result.outcome = CoverageOutcome::kNothingToCover;
    result.reason = "holes and zones leave nothing of the area";
    return result;
  }
  if (auto bad = check_lines(query, area)) return std::move(*bad);
  const SweepTask task = task_of(query, std::move(area), std::move(zones));
  const Sweep sweep =
      query.bearing ? sweep_at(task, *query.bearing, {}) : best_sweep(task);
  if (sweep.too_many) {
    result.outcome = CoverageOutcome::kTooManyLines;
    result.reason = fmt::format(
        "corners, holes and zones make more than {} lines; a wider swath makes fewer",
        kMaxLines);
    return result;
  }
  if (sweep.lines.empty()) {
    result.outcome = CoverageOutcome::kNothingToCover;
    result.reason = "zones and the distance to be kept from them leave no line";
    return result;
  }
  return described(query, task, sweep);
}

}  // namespace skein::solve
