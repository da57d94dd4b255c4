// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/aa_star.h"
#include "skein/solve/path/link.h"
#include "skein/solve/path/lower_bound.h"
#include "skein/solve/path/query_check.h"

namespace skein::solve {
namespace {

// Headings this near to the plan's are on it [rad].
constexpr double kOnHeading = 0.02;
// Where the plan is left: parts of the time until the conflict.
constexpr std::array kLeaves = {0.6, 0.0};
// Where it is joined again, after the conflict: turning times.
constexpr std::array kJoins = {0.5, 2.0, 5.0};

// Tries that use up their expansions, before another path is planned.
constexpr std::int64_t kTries = 3;

struct Joint {
  double leave, join;  // on the old plan's times
};

class Repairer {
 public:
  Repairer(const FlightPlan& old, const PathQuery& query, AirspaceMap& map,
           const RepairOptions& options)
      : old_(old), query_(query), map_(map), options_(options) {}

  RepairedPath run();

 private:
  bool on_plan() const;
  double clear_after() const;
  std::vector<Joint> joints(double conflict, bool on_plan) const;
  void rejoin(const Joint& joint);
  void plan_anew();

  const FlightPlan& old_;
  const PathQuery& query_;
  AirspaceMap& map_;
  const RepairOptions& options_;
  RepairedPath out_;
};

bool Repairer::on_plan() const {
  const double now = query_.start_time;
  if (old_.empty() || now < model::start_of(old_) || now >= model::end_time_of(old_))
    return false;
  const model::FlightMoment m = model::moment_at(old_, now);
  return (m.p_N - query_.start.p_N).norm() <= options_.on_plan &&
         std::abs(geo::wrap_pi(m.heading - query_.start.heading)) <= kOnHeading;
}

// The time from which on all of the rest of the old plan is free.
double Repairer::clear_after() const {
  const FlightPlan rest = part_of(old_, query_.start_time, model::end_time_of(old_));
  double clear = query_.start_time;
  for (const FlightElement& e : rest) {
    if (map_.is_free(e)) continue;
    // By quarters of the turning time: the last piece that is not free.
    const double step = full_turn(query_) / 16;
    const int count = std::max(1, static_cast<int>(std::ceil(e.duration / step)));
    for (int i = count - 1; i >= 0; --i) {
      const double begin = e.start + e.duration * i / count;
      const double end = e.start + e.duration * (i + 1) / count;
      if (map_.is_free(part_of({e}, begin, end))) continue;
      clear = end;
      break;
    }
  }
  return clear;
}

std::vector<Joint> Repairer::joints(double conflict, bool on_plan) const {
  const double now = query_.start_time, end = model::end_time_of(old_);
  const double turn = full_turn(query_);
  const double clear = on_plan ? clear_after() : std::max(now, clear_after());
  std::vector<Joint> out;
  for (const double j : kJoins) {
    const double join = std::min(end, clear + j * turn);
    for (const double l : kLeaves) {
      if (!on_plan && l > 0) continue;
      // Far before a conflict nothing is gained by leaving early.
      const double first = std::max(now, conflict - 4 * turn);
      out.push_back({first + l * (conflict - first), join});
    }
    if (join == end) break;
  }
  return out;
}

void Repairer::rejoin(const Joint& joint) {
  FlightPlan plan;
  PathQuery bypass = query_;
  if (joint.leave > query_.start_time) {
    plan = part_of(old_, query_.start_time, joint.leave);
    const model::FlightMoment m = model::moment_at(old_, joint.leave);
    bypass.start = {m.p_N, m.heading};
    bypass.start_time = joint.leave;
  }
  const double end = model::end_time_of(old_);
  const model::FlightMoment m = model::moment_at(old_, joint.join);
  if (joint.join < end) bypass.goal = {m.p_N, m.heading};
  bypass.budget.expansions = options_.expansions;
  bypass.budget.first = false;
  const PlannedPath path = AaStar({.manoeuvres = false}).plan(bypass, map_);
  out_.path.expansions += path.expansions;
  if (path.plan.empty()) return;
  model::append(plan, path.plan);
  const double joined = model::end_time_of(plan);
  if (joint.join < end) model::append(plan, part_of(old_, joint.join, end));
  const double time = model::end_time_of(plan) - query_.start_time;
  if (time >= out_.path.duration || !map_.is_free(plan)) return;
  out_.how = Repair::kRejoined;
  out_.path.plan = std::move(plan);
  out_.path.duration = time;
  out_.left_at = bypass.start_time;
  out_.joined_at = joined;
}

void Repairer::plan_anew() {
  PathQuery anew = query_;
  anew.budget.expansions = std::min(query_.budget.expansions, options_.anew);
  PlannedPath path = AaStar().plan(anew, map_);
  path.expansions += out_.path.expansions;
  const bool nothing = path.plan.empty() && out_.path.plan.empty();
  if (nothing && path.outcome == PlanningOutcome::kNothingFound &&
      anew.budget.expansions < query_.budget.expansions) {
    const std::int64_t before = path.expansions;
    path = AaStar().plan(query_, map_);
    path.expansions += before;
  }
  if (path.duration < out_.path.duration || out_.path.plan.empty()) {
    out_.how = path.plan.empty() ? Repair::kFailed : Repair::kAnew;
    out_.path = std::move(path);
  } else {
    out_.path.expansions = path.expansions;
  }
}

RepairedPath Repairer::run() {
  const bool on = on_plan();
  const double now = query_.start_time;
  double conflict = now;
  if (on) {
    FlightPlan rest = part_of(old_, now, model::end_time_of(old_));
    const auto c = map_.first_conflict(rest);
    if (!c) {
      out_.how = Repair::kKept;
      out_.path.outcome = PlanningOutcome::kFound;
      out_.path.duration = model::duration(rest);
      out_.path.plan = std::move(rest);
      return out_;
    }
    out_.reason = "the plan comes " + c->what;
    conflict = c->time;
  } else {
    out_.reason = "the aircraft is not on its plan";
  }
  const Link direct = link(query_.start, query_.goal, query_);
  const double min = min_time(direct, query_.start, query_.goal, query_);
  if (auto refused = refuse_blocked(map_, now + min)) {
    out_.path = std::move(*refused);
    return out_;
  }
  const double good = 1 + options_.worse;
  SearchBudget budget(query_.budget);
  out_.path.bound = std::max(min, lower_bound(query_, budget).time);
  if (!old_.empty() && model::end_time_of(old_) > now)
    for (const Joint& joint : joints(conflict, on)) {
      if (out_.path.expansions >= kTries * options_.expansions) break;
      rejoin(joint);
      if (out_.path.duration <= good * out_.path.bound) break;
    }
  map_.ask(query_);
  if (!(out_.path.duration <= good * out_.path.bound)) plan_anew();
  if (out_.how == Repair::kRejoined) {
    out_.path.outcome = PlanningOutcome::kFound;
    out_.path.bound = std::min(out_.path.bound, out_.path.duration);
  }
  return std::move(out_);
}

}  // namespace

std::string_view name_of(Repair how) {
  constexpr std::array<std::string_view, 4> kNames = {"kept", "rejoined", "anew",
                                                      "failed"};
  return kNames[static_cast<std::size_t>(how)];
}

FlightPlan part_of(const FlightPlan& plan, double from, double until) {
  FlightPlan out;
  for (const FlightElement& e : plan) {
    const double begin = std::max(from, e.start);
    const double end = std::min(until, e.start + e.duration);
    if (!(begin < end)) continue;
    FlightElement piece = e;
    const model::FlightMoment m = model::moment(e, begin - e.start);
    piece.start = begin;
    piece.duration = end - begin;
    piece.p_N = m.p_N;
    piece.heading = m.heading;
    piece.climb_rate = -m.v_N.z();
    out.push_back(piece);
  }
  return out;
}

RepairedPath repair(const FlightPlan& old, const PathQuery& query, AirspaceMap& now,
                    const RepairOptions& options) {
  if (auto refused = refuse_flight(query)) {
    RepairedPath out;
    out.path = std::move(*refused);
    return out;
  }
  now.ask(query);
  return Repairer(old, query, now, options).run();
}

RepairedPath repair(const FlightPlan& old, const PathQuery& query,
                    const RepairOptions& options) {
  if (auto refused = refuse_airspace(query)) {
    RepairedPath out;
    out.path = std::move(*refused);
    return out;
  }
  AirspaceMap map(query);
  return repair(old, query, map, options);
}

}  // namespace skein::solve
