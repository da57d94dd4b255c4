// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/plan/plan_task.h"

#include <cmath>

#include "skein/model/path/flight_plan.h"
#include "skein/model/path/wind_triangle.h"
#include "skein/solve/path/join.h"
#include "skein/solve/target/timed_flight.h"

namespace skein::reasoning {
namespace {

PlannedTaskOptions as_it_is() {
  PlannedTaskOptions options;
  options.over_ground = false;
  options.for_wind = false;
  return options;
}

constexpr int kAirspeeds = 8;        // that are tried until one is kept
constexpr double kSameSpeed = 1e-3;  // [m/s]

// To a place at a time, or as soon after as can be, with a course over ground there: the
// heading for it depends on the airspeed, which is known only with the way.
FlightPlan way_in_time(solve::TimedLeg leg, double course, double time) {
  solve::TimedFlight flight;
  double airspeed = leg.limits.airspeed;
  for (int i = 0; i < kAirspeeds; ++i) {
    flight = solve::arrive_at(leg, time);
    if (flight.status == solve::TimedStatus::kGap)
      flight = solve::arrive_at(leg, flight.next);
    if (flight.plan.empty() || std::abs(flight.airspeed - airspeed) < kSameSpeed) break;
    airspeed = flight.airspeed;
    leg.to.heading =
        model::heading_for_course(course, airspeed, leg.wind).value_or(leg.to.heading);
  }
  return flight.plan;
}

}  // namespace

PlanTask::PlanTask(const FlightContext& context, const FlyPlan& order)
    : PlannedTask(context, as_it_is()), order_(order) {}

std::optional<double> PlanTask::altitude_msl() const {
  return -order_.plan[next_].p_N.z();
}

double PlanTask::altitude_of_plans(const NavEstimate& nav) const {
  return -nav.p_N.z();
}

PlannedTask::Part PlanTask::plan_part(const Start& start, const TaskStep&) {
  Part part;
  FlightPlan rest(order_.plan.begin() + static_cast<std::ptrdiff_t>(next_),
                  order_.plan.end());
  // On its course: in the wind of now that is another heading than in the plan's.
  const double course = geo::bearing(geo::horizontal(model::moment(rest.front(), 0).v_N));
  const FlightState begin{rest.front().p_N, model::heading_for_course(
                                                course, start.limits.airspeed, start.wind)
                                                .value_or(rest.front().heading)};
  part.plan = solve::join(start.state, begin, start.limits, start.wind, start.time);
  const bool there = (start.state.p_N - begin.p_N).norm() < 1;
  if (part.plan.empty() && !there) {
    part.why_not = "there is no path to the start of the plan in this wind";
    return part;
  }
  if (!order_.any_time && model::start_of(rest) > start.time)
    if (FlightPlan timed =
            way_in_time({start.state, begin, start.time, start.limits, start.wind, true},
                        course, model::start_of(rest));
        !timed.empty())
      part.plan = std::move(timed);
  const double at = part.plan.empty() ? start.time : model::end_time_of(part.plan);
  rest = model::starting_at(std::move(rest), at);
  on_it_ = false;
  part.milestones.push_back(at);
  for (const FlightElement& e : rest) part.milestones.push_back(e.start + e.duration);
  part.plan.insert(part.plan.end(), rest.begin(), rest.end());
  return part;
}

// Its start, then the end of each element.
void PlanTask::pass(const TaskStep&) {
  if (on_it_ && next_ + 1 < order_.plan.size()) ++next_;
  on_it_ = true;
}

TaskProgress PlanTask::progress(const AgentInput& in) const {
  TaskProgress progress = PlannedTask::progress(in);
  if (!progress.done)
    progress.share = static_cast<double>(next_) / static_cast<double>(order_.plan.size());
  return progress;
}

TaskKind PlanTask::rest() const {
  FlyPlan rest = order_;
  rest.plan.erase(rest.plan.begin(),
                  rest.plan.begin() + static_cast<std::ptrdiff_t>(next_));
  return rest;
}

}  // namespace skein::reasoning
