// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/fleet_plan.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/aa_star.h"
#include "skein/solve/path/query_check.h"
#include "skein/solve/path/trajectory.h"

namespace skein::solve {
namespace {

// Starts are tried this far apart [s], and this far where a search is made for each.
constexpr double kStep = 3, kSearchStep = 30;
// How often the order is changed for those who find no flight.
constexpr int kRounds = 5;

bool is_stopped(const FleetQuery& query) {
  return query.common.budget.stop && query.common.budget.stop();
}

class Fleet {
 public:
  explicit Fleet(const FleetQuery& query) : query_(query), map_(query.common) {
    // The map points to what is kept here.
    flights_.reserve(query.members.size());
  }

  FleetPlan run(const std::vector<std::size_t>& order);

 private:
  PathQuery query_of(const FleetMember& member, double start) const;
  PlannedPath plan(const FleetMember& member);
  void go_straight(const FleetMember& member, PlannedPath& best);
  void search(const FleetMember& member, PlannedPath& best);
  double arrival(const PlannedPath& path) const {
    return path.plan.empty() ? path.duration : model::end_time_of(path.plan);
  }

  const FleetQuery& query_;
  AirspaceMap map_;
  std::vector<PlannedFlight> flights_;
};

PathQuery Fleet::query_of(const FleetMember& member, double start) const {
  PathQuery q = query_.common;
  q.start = member.start;
  q.goal = member.goal;
  q.start_time = start;
  q.limits = member.limits;
  q.budget.first = true;
  return q;
}

// The earliest start from which the link is free.
void Fleet::go_straight(const FleetMember& member, PlannedPath& best) {
  PathQuery q = query_of(member, member.earliest_start);
  const Link l = link(q.start, q.goal, q);
  for (double t = member.earliest_start; t <= member.latest_start; t += kStep) {
    if (is_stopped(query_)) return;
    FlightPlan plan = to_flight_plan(l, q.start, t, q);
    ++best.expansions;
    if (plan.empty() || !map_.is_free(plan)) continue;
    best.outcome = PlanningOutcome::kFound;
    best.duration = l.duration;
    best.plan = std::move(plan);
    return;
  }
}

void Fleet::search(const FleetMember& member, PlannedPath& best) {
  PlannedPath last;
  for (double t = member.earliest_start; t <= member.latest_start; t += kSearchStep) {
    if (is_stopped(query_)) break;
    const PathQuery q = query_of(member, t);
    const Link l = link(q.start, q.goal, q);
    if (!best.plan.empty() && t + min_time(l, q.start, q.goal, q) >= arrival(best))
      return;
    PlannedPath path = AaStar().plan(q, map_);
    best.expansions += path.expansions;
    const bool better =
        !path.plan.empty() && (best.plan.empty() || arrival(path) < arrival(best));
    if (!better) {
      if (best.plan.empty()) last = std::move(path);
      continue;
    }
    path.expansions = best.expansions;
    best = std::move(path);
  }
  if (!best.plan.empty()) return;
  last.expansions = best.expansions;
  best = std::move(last);
}

PlannedPath Fleet::plan(const FleetMember& member) {
  const PathQuery q = query_of(member, member.earliest_start);
  if (auto refused = refuse_flight(q)) return *refused;
  map_.ask(q);
  PlannedPath best;
  go_straight(member, best);
  const bool at_once =
      !best.plan.empty() && model::start_of(best.plan) == member.earliest_start;
  if (!at_once) search(member, best);
  return best;
}

FleetPlan Fleet::run(const std::vector<std::size_t>& order) {
  FleetPlan out;
  out.paths.resize(query_.members.size());
  const double time = std::max(query_.zone.ahead, query_.zone.behind);
  for (const std::size_t i : order) {
    const FleetMember& member = query_.members[i];
    PlannedPath& path = out.paths[i];
    path = plan(member);
    if (path.plan.empty()) continue;
    ++out.planned;
    flights_.push_back(
        {member.who, path.plan, {time, time, query_.zone.across}, query_.height});
    map_.add(flights_.back());
  }
  return out;
}

// Those without a flight first.
std::vector<std::size_t> promoted(const std::vector<std::size_t>& order,
                                  const FleetPlan& plan) {
  std::vector<std::size_t> next = order;
  std::stable_partition(next.begin(), next.end(),
                        [&](std::size_t i) { return plan.paths[i].plan.empty(); });
  return next;
}

}  // namespace

FleetPlan plan_fleet(const FleetQuery& query) {
  FleetPlan best;
  if (auto refused = refuse_airspace(query.common)) {
    best.paths.assign(query.members.size(), *refused);
    return best;
  }
  std::vector<std::size_t> order(query.members.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (int i = 0; i < kRounds; ++i) {
    FleetPlan plan = Fleet(query).run(order);
    order = promoted(order, plan);
    const bool all = plan.planned == query.members.size();
    if (i == 0 || plan.planned > best.planned) best = std::move(plan);
    if (all || is_stopped(query)) break;
  }
  return best;
}

}  // namespace skein::solve
