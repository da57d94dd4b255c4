// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "skein/layer/reasoning/agent/hold_planner.h"
#include "skein/layer/reasoning/agent/separation_planner.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/repair.h"

// What an aircraft flies behind the end of its task, where it stays, and when it leaves
// that for another flight.

namespace skein::reasoning {
namespace {

constexpr double kSamePlaceToHold = 15;  // a circle asked for there is the same one [m]
constexpr double kSameHeightToHold = 8;  // the same [m]
constexpr double kMoveAgain = 5;         // of a circle, after it was placed [s]
constexpr double kTimeToMove = 8;        // to a conflict: a circle is moved before [s]
constexpr double kHoldAhead = 60;        // beyond the horizon that circles are said [s]
constexpr double kLongestWait = 60;      // for others, before a flight is begun [s]
constexpr double kAskAgain = 2;          // whether it can be begun [s]
constexpr double kStillTheSame = 5;      // longer, for a task that plans nothing else [s]
// Neighbours that circle begin in turns, by their numbers: nobody knows yet what one
// flies that has begun in the same moment.
constexpr double kTurnLength = 1.5;         // of one of them, in periods of places [s]
constexpr std::uint32_t kTurnsInCycle = 6;  // until it has the next one
constexpr double kNextStepOfTask = 0.5;     // a task says so early that it is done [s]
constexpr double kNearCircle = 2;           // of radii: a circle near by will do

// When the next turn of an aircraft to begin another flight starts, or its present one
// did [s].
double turn_of(EntityId self, double now, double length) {
  const double cycle = kTurnsInCycle * length;
  const double start =
      cycle * std::floor(now / cycle) + length * (self.value % kTurnsInCycle);
  return now < start + length ? start : start + cycle;
}

bool is_same_place(const Circling& a, const Circling& b) {
  if (a.altitude_msl.has_value() != b.altitude_msl.has_value()) return false;
  return (a.centre - b.centre).norm() <= kSamePlaceToHold &&
         std::abs(a.altitude_msl.value_or(0) - b.altitude_msl.value_or(0)) <=
             kSameHeightToHold;
}

}  // namespace

// What is flown now is a circle, by a plan or not.
bool SeparationPlanner::circles() const {
  return expected_ && !by_others_ && kind_ == FlightIntent{0, Circling{}}.what.index();
}

// Whether the circle that is placed is the one that is asked for.
bool SeparationPlanner::is_held(const Circling& requested) const {
  if (!hold_) return false;
  if (is_same_place(requested, hold_->requested)) return true;
  return requested.near_by && circles() && !requested.altitude_msl &&
         (requested.centre - hold_->flown.centre).norm() <
             kNearCircle * context_.limits.turn_radius;
}

// The circle that is asked for, where it is flown.
const FlightIntent* SeparationPlanner::held(const FlightIntent* asked,
                                            const TaskStep& step) {
  const auto* requested = std::get_if<Circling>(&asked->what);
  if (!requested) return asked;
  const double now = step.in.now.seconds();
  const bool is_near = is_held(*requested);
  if (is_near && !is_same_place(*requested, hold_->requested))
    hold_->requested = *requested;
  else if (!is_near || must_move_hold(step.in.now))
    place_hold(*requested, *step.in.nav, now, step);
  if (is_same_place(hold_->flown, *requested)) return asked;
  held_.number = asked->number;
  held_.what = hold_->flown;
  return &held_;
}

void SeparationPlanner::place_hold(const Circling& requested, const NavEstimate& from,
                                   double begin, const TaskStep& step) {
  const PathQuery query = query_of(step);
  FlightContext context = context_;
  context.limits = query.limits;
  FlightCheck check(query, step.safety.zones().zones());
  HoldSituation situation{step.in.now, context, separator_,
                          options_.horizon + kHoldAhead};
  if (hold_ && is_same_place(requested, hold_->requested))
    situation.before = hold_->flown;
  const Circling flown = place_to_hold(requested, from, begin, situation, check);
  hold_ = Hold{requested, flown, step.in.now};
}

// Somebody who has the right of way needs the place.
bool SeparationPlanner::must_move_hold(Time now) const {
  if (!hold_ || (now - hold_->placed).seconds() < kMoveAgain) return false;
  if (!foreseen_ && !legs_end_ && !circles()) return false;
  // What leads it out of others' way is flown on; behind the end of a task that stays.
  if (!foreseen_ && separator_.changed() && !separator_.is_clear(now)) return false;
  const auto conflict = separator_.is_to_move(now, foreseen_ || legs_end_);
  return conflict && *conflict > now.seconds() + kTimeToMove;
}

// Says what follows the task's flight as soon as others look so far ahead, and says
// another circle where that one has to be moved.
void SeparationPlanner::foresee_end(const Itinerary& itinerary, const TaskStep& step) {
  if (!itinerary.stays || options_.method == SeparationMethod::kNone) return;
  const double now = step.in.now.seconds();
  const bool is_taken_in = separator_.is_about(wanted_.number);
  // What has been wanted just now is not known to the separator yet.
  const FlightPlan& plan = is_taken_in ? separator_.plan() : wanted_.plan;
  const std::vector<double>& milestones =
      is_taken_in ? separator_.milestones() : wanted_.milestones;
  const std::size_t behind = foreseen_ ? 1 : 0;  // the end of the circle
  if (milestones.size() <= behind) return;
  const std::size_t points = milestones.size() - behind;
  const double end = milestones[points - 1];
  if (end <= now || end - now >= options_.horizon) return;
  if (foreseen_ && !must_move_hold(step.in.now)) return;
  const model::FlightMoment m = model::moment_at(plan, end);
  NavEstimate there = *step.in.nav;
  there.p_N = m.p_N;
  there.v_N = m.v_N;
  there.heading = m.heading;
  const Circling requested =
      foreseen_ ? hold_->requested : Circling{geo::horizontal(m.p_N), {}};
  place_hold(requested, there, end, step);
  FlightContext context = context_;
  context.limits = query_of(step).limits;
  const ExpectedFlight stay = expected_flight({0, hold_->flown}, 0, there, context, end,
                                              options_.horizon + kHoldAhead);
  if (stay.plan.empty()) return;
  const bool changed = is_taken_in && separator_.changed();
  WantedFlight wanted;
  wanted.number = counted_ + 1;
  wanted.plan = solve::part_of(plan, model::start_of(plan), end);
  wanted.plan.insert(wanted.plan.end(), stay.plan.begin(), stay.plan.end());
  wanted.milestones.assign(milestones.begin(),
                           milestones.begin() + static_cast<std::ptrdiff_t>(points));
  wanted.milestones.push_back(model::end_time_of(wanted.plan));
  wanted.held_from = end;
  ++counted_;
  wanted_ = std::move(wanted);
  points_before_ = task_points_ - std::min(task_points_, points);
  as_task_ = as_task_ && !changed;
  foreseen_ = true;
}

// The circle around the last point of legs, where that is in what is expected: a place
// apart from others.
// @returns  whether it is.
bool SeparationPlanner::stay_behind_legs(const FlightIntent& given, const TaskStep& step,
                                         ExpectedFlight& ahead) {
  const auto* legs = std::get_if<Legs>(&given.what);
  const double now = step.in.now.seconds();
  if (!legs || !ahead.stays_from || *ahead.stays_from - now >= options_.horizon)
    return false;
  const double end = *ahead.stays_from;
  const model::FlightMoment m = model::moment_at(ahead.plan, end);
  NavEstimate there = *step.in.nav;
  there.p_N = m.p_N;
  there.v_N = m.v_N;
  there.heading = m.heading;
  const Circling requested{legs->points.back(), legs->altitude_msl};
  if (!hold_ || !is_same_place(requested, hold_->requested) ||
      must_move_hold(step.in.now))
    place_hold(requested, there, end, step);
  FlightContext context = context_;
  context.limits = query_of(step).limits;
  const ExpectedFlight stay = expected_flight({0, hold_->flown}, 0, there, context, end,
                                              options_.horizon + kHoldAhead);
  if (stay.plan.empty()) return false;
  ahead.plan = solve::part_of(ahead.plan, model::start_of(ahead.plan), end);
  ahead.plan.insert(ahead.plan.end(), stay.plan.begin(), stay.plan.end());
  return true;
}

// The task's flight is over, and it is asked for the circle that has been said.
bool SeparationPlanner::goes_on_as_foreseen(const FlightIntent& given) {
  const auto* circling = std::get_if<Circling>(&given.what);
  if (!foreseen_ || expected_ || !circling || !hold_ ||
      !is_same_place(*circling, hold_->flown))
    return false;
  stay_as_foreseen(given.number);
  return true;
}

// What was said goes on as a circle like any other.
void SeparationPlanner::stay_as_foreseen(std::uint32_t number) {
  if (own_as_task_) own_number_ = 0;
  foreseen_ = legs_end_ = false;
  expected_ = flies_as_expected_ = true;
  by_others_ = has_legs_ = false;
  given_ = number;
  kind_ = FlightIntent{0, Circling{}}.what.index();
  circled_ = hold_->flown;
  points_ahead_ = reported_ = passed_before_ = 0;
}

// Whether the task's flight has been flown to its end, and its circle has begun.
bool SeparationPlanner::is_past_task(Time now) const {
  const std::vector<double>& milestones = separator_.milestones();
  return milestones.size() < 2 ||
         milestones[milestones.size() - 2] <= now.seconds() + kNextStepOfTask;
}

// Whether a flight is begun. Who circles waits there while it would lead into a conflict
// that has to be solved at once.
bool SeparationPlanner::begins(const FlightIntent& given, const WantedFlight& wanted,
                               const TaskStep& step) {
  const Time now = step.in.now;
  const bool stays = circles() && flies_as_expected_ && !landing_.approaches();
  // It has been flown to its end, and the next one begins.
  const bool is_over = foreseen_ && !expected_ && hold_ && is_past_task(now);
  if (!stays && !is_over) {
    waits_for_ = 0;
    return true;
  }
  if (waits_for_ == 0) waiting_since_ = now;
  const double waited = (now - waiting_since_).seconds();
  if (waits_for_ == given.number && waited < kLongestWait + kStillTheSame) return false;
  const double t = now.seconds(), length = kTurnLength * options_.place_period;
  const double turn = separator_.has_neighbours_in_circles(now, step.in.nav->p_N)
                          ? turn_of(context_.self, t, length)
                          : t;
  const PathQuery query = query_of(step);
  const bool begins_now =
      waited > kLongestWait ||
      (turn <= t &&
       separator_.begins(separation_step(step, query, false, false), wanted));
  if (begins_now) {
    waits_for_ = 0;
    return true;
  }
  if (is_over) stay_as_foreseen(given_);
  waits_for_ = given.number;
  asks_again_ = Time::from_seconds(turn > t ? turn : t + kAskAgain);
  return false;
}

// Of what is flown led another way: what the task knows of it.
FlightProgress SeparationPlanner::progress_of_task(const FlightProgress& flown) const {
  FlightProgress progress = flown;
  progress.mended = true;
  // What was led another way before is what is wanted now: the task plans anew.
  progress.refused = flown.refused && !separator_.changed();
  progress.passed = points_before_ + separator_.passed() + flown.passed;
  if (!foreseen_) return progress;
  const std::vector<double>& milestones = separator_.milestones();
  progress.passed = std::min(progress.passed, task_points_);
  progress.done = progress.passed >= task_points_;
  const double circle =
      milestones.size() < 2 ? 0 : milestones.back() - milestones[milestones.size() - 2];
  progress.time_to_go = std::max(0.0, flown.time_to_go - circle);
  return progress;
}

}  // namespace skein::reasoning
