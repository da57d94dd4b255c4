// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/planned_task.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/layer/reasoning/trajectory/altitude.h"
#include "skein/layer/reasoning/trajectory/level_out.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr double kTryAgain = 10;  // after there was no plan, or it was refused [s]
constexpr double kFlown = 5;      // a plan for so long is not refused any more [s]
constexpr int kMaxRefusals = 3;
constexpr double kPlanAhead =
    10;  // the next part is planned when this little is left [s]
constexpr double kWindChange = 2;       // of the wind, for which it plans anew [m/s]
constexpr double kBetweenPlans = 15;    // for another wind, at least [s]
constexpr double kLargeWindChange = 4;  // for which it does not wait so long [m/s]
constexpr double kSettled = 2;          // but only this long [s]

// At the start of a run the wind is not known yet, and what keeps apart from others is
// made of the first plans: those are made anew while it is found, each twice as long
// after the one before.
constexpr double kFirstWindChange = 0.15;  // [m/s]
constexpr int kFirstPlans = 2;

// What of a plan is not over yet.
FlightPlan rest_of(const FlightPlan& plan, double now) {
  FlightPlan rest;
  for (const FlightElement& e : plan)
    if (e.start + e.duration > now) rest.push_back(e);
  return rest;
}

}  // namespace

double PlannedTask::altitude_of_plans(const NavEstimate& nav) const {
  return altitude_over(*context_.map, geo::horizontal(nav.p_N), geo::horizontal(nav.v_N),
                       context_.altitude_agl, context_.limits.climb_rate);
}

const FlightIntent* PlannedTask::plan(const TaskStep& step, AgentOutput& out) {
  if (done_) return stay(step);
  if (const FlightIntent* own = before(step, out)) return own;
  if (done_) return stay(step);
  const FlightProgress& flight = step.flight;
  const bool flies = intent_.number != 0 && flight.number == intent_.number;
  if (flies) {
    time_to_go_ = flight.time_to_go;
    if (!flight.refused && (step.in.now - planned_).seconds() > kFlown) refusals_ = 0;
    for (; counted_ < std::min(flight.passed, milestones_.size()); ++counted_) pass(step);
    if (flight.refused) {
      // The autopilot has reported why.
      renew();
      // What was led around a zone may be flown from elsewhere.
      if (!flight.mended && ++refusals_ >= kMaxRefusals)
        impossible_ = "the autopilot refuses its plans";
      try_again_ = step.in.now + Time::from_seconds(kTryAgain);
    } else if (flight.done && last_) {
      if (finish(step, out)) {
        done_ = true;
        return stay(step);
      }
      renew();
    }
  }
  if (must_plan(step) && step.in.now >= try_again_) {
    if (!plan_on(step, out)) return nullptr;
    if (done_) return stay(step);
  } else if (intent_.number == 0) {
    return nullptr;
  }
  was_off_ = step.safety.off_plan();
  return &intent_;
}

bool PlannedTask::must_plan(const TaskStep& step) const {
  if (intent_.number == 0) return true;
  const bool flies = step.flight.number == intent_.number;
  if (!flies) return false;
  if (!last_ && step.flight.time_to_go < kPlanAhead) return true;
  const double change = (step.in.nav->wind_N - wind_).norm();
  const double since = (step.in.now - planned_).seconds();
  const bool other_wind = options_.for_wind && !step.flight.by_sight &&
                          ((change > kWindChange && since > kBetweenPlans) ||
                           (change > kLargeWindChange && since > kSettled) ||
                           (change > kFirstWindChange && plans_ <= kFirstPlans &&
                            since > kSettled * std::ldexp(1, plans_ - 1)));
  const bool off =
      !options_.rejoins && !options_.stubborn && step.safety.off_plan() && !was_off_;
  return other_wind || off;
}

// From where the aircraft is or, where a part comes to its end as planned, from there.
PlannedTask::Start PlannedTask::start_of_part(const TaskStep& step, bool goes_on) const {
  const NavEstimate& nav = *step.in.nav;
  Start start;
  start.limits = planning_limits(context_.limits, options_.radius_factor);
  start.wind = nav.wind_N;
  start.time = step.in.now.seconds();
  start.state = {{nav.p_N.x(), nav.p_N.y(), -altitude_of_plans(nav)}, nav.heading};
  if (goes_on) {
    const model::FlightMoment at = model::end_of(plan_.back());
    start.time = model::end_time_of(plan_);
    start.state = {at.p_N, at.heading};
  }
  return start;
}

// What has been passed since the flight was last looked at.
void PlannedTask::count_passed(const TaskStep& step, double now) {
  if (intent_.number == 0 || step.flight.mended) return;
  for (; counted_ < milestones_.size() && milestones_[counted_] <= now; ++counted_)
    pass(step);
}

bool PlannedTask::plan_on(const TaskStep& step, AgentOutput& out) {
  const double now = step.in.now.seconds();
  count_passed(step, now);
  const bool goes_on = intent_.number != 0 && !last_ && !step.flight.mended &&
                       now < model::end_time_of(plan_) &&
                       step.flight.time_to_go < kPlanAhead;
  if (!goes_on) {
    plan_.clear();
    milestones_.clear();
    counted_ = 0;
  }
  Start start = start_of_part(step, goes_on);
  std::optional<FlightElement> level;  // before what is planned
  if (!goes_on) level = level_out(*step.in.nav, start.limits, start.state, start.time);
  if (level) {
    start.state.p_N = model::end_of(*level).p_N;
    start.time += level->duration;
  }
  Part part = plan_part(start, step);
  if (part.nothing) {
    last_ = true;
    done_ = goes_on ? done_ : finish(step, out);
    return goes_on || done_;
  }
  if (level && !part.plan.empty()) part.plan.insert(part.plan.begin(), *level);
  if (take(std::move(part), now, step, out)) return true;
  try_again_ = step.in.now + Time::from_seconds(kTryAgain);
  // What is left of a part before is flown to its end.
  return goes_on;
}

bool PlannedTask::take(Part part, double now, const TaskStep& step, AgentOutput& out) {
  const bool stuck = part.plan.empty();
  if (stuck && part.never) impossible_ = part.why_not;
  if (stuck && !stuck_ && !part.never)
    out.events.push_back({step.in.now, context_.self, EventKind::kNoPlan, part.why_not});
  stuck_ = stuck;
  if (stuck) return false;
  plan_ = rest_of(plan_, now);
  plan_.insert(plan_.end(), part.plan.begin(), part.plan.end());
  milestones_.erase(milestones_.begin(),
                    milestones_.begin() + static_cast<std::ptrdiff_t>(counted_));
  milestones_.insert(milestones_.end(), part.milestones.begin(), part.milestones.end());
  counted_ = 0;
  last_ = part.last;
  wind_ = step.in.nav->wind_N;
  planned_ = step.in.now;
  ++plans_;
  time_to_go_ = model::end_time_of(plan_) - now;
  Itinerary itinerary;
  itinerary.plan = plan_;
  itinerary.milestones = milestones_;
  itinerary.in_time = options_.in_time;
  itinerary.over_ground = options_.over_ground;
  itinerary.rejoins = options_.rejoins;
  itinerary.stays = options_.stays && last_;
  intent_.number = step.intents.next();
  intent_.what = std::move(itinerary);
  return true;
}

const FlightIntent* PlannedTask::stay(const TaskStep& step) {
  if (std::holds_alternative<Circling>(intent_.what)) return &intent_;
  Vec2 place = geo::horizontal(step.in.nav->p_N);
  if (const auto own = end_place())
    place = *own;
  else if (!plan_.empty())
    place = geo::horizontal(model::end_of(plan_.back()).p_N);
  intent_.what = Circling{place, {}};
  return &intent_;
}

TaskProgress PlannedTask::progress(const AgentInput&) const {
  TaskProgress progress;
  progress.done = done_;
  progress.share = done_ ? 1 : 0;
  progress.impossible = impossible_;
  if (done_)
    progress.time_to_go = 0;
  else if (last_ && intent_.number != 0)
    progress.time_to_go = time_to_go_;
  return progress;
}

}  // namespace skein::reasoning
