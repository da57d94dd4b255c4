// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/plan_mending.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/data/airspace/airspace.h"
#include "skein/model/path/flight_plan.h"
#include "skein/model/path/wind_triangle.h"
#include "skein/solve/path/airspace_map.h"
#include "skein/solve/path/repair.h"

namespace skein::reasoning {
namespace {

constexpr double kMendedRadius = 1.1;          // of the turn radius: room to correct
constexpr std::int64_t kLegExpansions = 3000;  // of a search, for one leg
constexpr int kMaxLegs = 20;                   // mended at a time

Airspace airspace_of(const FlightPlan& plan, const TrajectoryStep& step) {
  Airspace airspace;
  airspace.zones = step.zones.obstacles(geo::horizontal(step.in.nav->p_N),
                                        geo::horizontal(model::end_of(plan.back()).p_N));
  return airspace;
}

double airspeed_at(const FlightPlan& plan, double time) {
  for (const FlightElement& e : plan)
    if (e.start + e.duration > time) return e.airspeed;
  return plan.back().airspeed;
}

// At the airspeed of the plan, with the same bank.
PathQuery query_of(const Airspace& airspace, const FlightPlan& plan,
                   const TrajectoryStep& step, const FlightContext& context) {
  PathQuery query;
  query.limits = planning_limits(context.limits, kMendedRadius);
  query.limits.airspeed = airspeed_at(plan, step.in.now.seconds());
  const double ratio = query.limits.airspeed / context.limits.airspeed;
  query.limits.turn_radius *= ratio * ratio;
  query.wind = step.in.nav->wind_N;
  query.start_time = step.in.now.seconds();
  query.ground_clearance = context.altitude_agl / 2;
  query.airspace = &airspace;
  query.terrain = context.map;
  query.budget.expansions = kLegExpansions;
  return query;
}

FlightState state_at(const FlightPlan& plan, double time) {
  const model::FlightMoment m = model::moment_at(plan, time);
  return {m.p_N, m.heading};
}

// Puts together what is flown of a plan.
class Mending {
 public:
  Mending(const FlightPlan& plan, const std::vector<double>& milestones,
          const TrajectoryStep& step, const FlightContext& context)
      : airspace_(airspace_of(plan, step)),
        query_(query_of(airspace_, plan, step, context)),
        map_(query_),
        rest_(plan),
        milestones_(milestones) {}

  MendedPlan run(const Vec3& here, double heading);

 private:
  bool mend_leg();
  FlightState goal_at(double time) const;
  void keep_until(double time);

  Airspace airspace_;
  PathQuery query_;  // its start is where the next leg begins
  solve::AirspaceMap map_;
  FlightPlan rest_;                 // not looked at yet, on its own times
  std::vector<double> milestones_;  // of the rest
  MendedPlan out_;
};

// On the plan's course: in the wind of now that may be another heading.
FlightState Mending::goal_at(double time) const {
  const model::FlightMoment m = model::moment_at(rest_, time);
  const double course = geo::bearing(geo::horizontal(m.v_N));
  return {m.p_N, model::heading_for_course(course, query_.limits.airspeed, query_.wind)
                     .value_or(m.heading)};
}

// A leg from the query's start to the first milestone of the rest that it can reach.
bool Mending::mend_leg() {
  const double now = query_.start_time;
  std::string why = "the plan has ended";
  for (std::size_t k = 0; k < milestones_.size(); ++k) {
    const double until = milestones_[k];
    if (until <= now) continue;
    query_.goal = goal_at(until);
    if (map_.conflict_at(query_.goal.p_N, until)) {
      why = "the place to go on from lies in a no-fly zone";
      continue;
    }
    solve::RepairedPath leg =
        solve::repair(solve::part_of(rest_, now, until), query_, map_);
    if (leg.path.plan.empty()) {
      why = leg.path.reason;
      continue;
    }
    model::append(out_.plan, std::move(leg.path.plan));
    const double arrival = model::end_time_of(out_.plan);
    out_.milestones.push_back(arrival);
    FlightPlan after = solve::part_of(rest_, until, model::end_time_of(rest_));
    milestones_.erase(milestones_.begin(),
                      milestones_.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    for (double& time : milestones_) time += arrival - until;
    rest_ = after.empty() ? FlightPlan() : model::starting_at(std::move(after), arrival);
    return true;
  }
  out_.reason = why;
  return false;
}

// What is free is kept as it is.
void Mending::keep_until(double time) {
  model::append(out_.plan, solve::part_of(rest_, model::start_of(rest_), time));
  while (!milestones_.empty() && milestones_.front() <= time) {
    out_.milestones.push_back(milestones_.front());
    milestones_.erase(milestones_.begin());
  }
  rest_ = solve::part_of(rest_, time, model::end_time_of(rest_));
}

MendedPlan Mending::run(const Vec3& here, double heading) {
  const double end = model::end_time_of(rest_);
  // At the altitude of the plan: an even climb by the rest of the leg is no plan.
  query_.start = {
      {here.x(), here.y(), state_at(rest_, std::min(query_.start_time, end)).p_N.z()},
      heading};
  int legs = 0;
  do {
    if (++legs > kMaxLegs || !mend_leg()) {
      if (out_.reason.empty()) out_.reason = "too many zones lie on the plan";
      out_.plan.clear();
      return std::move(out_);
    }
    if (rest_.empty()) break;
    const auto conflict = map_.first_meeting(rest_);
    if (!conflict) {
      keep_until(model::end_time_of(rest_));
      break;
    }
    // Up to the last milestone before it.
    const auto after =
        std::lower_bound(milestones_.begin(), milestones_.end(), conflict->time);
    if (after != milestones_.begin()) keep_until(*std::prev(after));
    query_.start_time = model::end_time_of(out_.plan);
    query_.start = state_at(out_.plan, query_.start_time);
  } while (!rest_.empty());
  const double later = model::end_time_of(out_.plan) - end;
  out_.reason = fmt::format("flies on by a plan of {:.0f} s, {:.0f} s {}",
                            model::duration(out_.plan), std::abs(later),
                            later < 0 ? "shorter" : "longer");
  return std::move(out_);
}

}  // namespace

bool comes_into_zone(const FlightPlan& plan, double after, const TrajectoryStep& step,
                     const FlightContext& context) {
  const FlightPlan rest = solve::part_of(plan, after, model::end_time_of(plan));
  if (rest.empty()) return false;
  const Airspace airspace = airspace_of(plan, step);
  const PathQuery query = query_of(airspace, plan, step, context);
  return solve::AirspaceMap(query).first_meeting(rest).has_value();
}

MendedPlan mend_plan(const FlightPlan& plan, const std::vector<double>& milestones,
                     const TrajectoryStep& step, const FlightContext& context) {
  return Mending(plan, milestones, step, context)
      .run(step.in.nav->p_N, step.in.nav->heading);
}

}  // namespace skein::reasoning
