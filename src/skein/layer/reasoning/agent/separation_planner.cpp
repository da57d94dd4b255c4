// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/separation_planner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/layer/reasoning/agent/expected_flight.h"
#include "skein/layer/reasoning/avoidance/flights/course_flight.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/flight_check.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/repair.h"

namespace skein::reasoning {
namespace {

constexpr double kExpected = 60;     // beyond the horizon that flights are expected [s]
constexpr double kExpectAgain = 20;  // at least so often [s]
constexpr double kMinExpected = 3;   // and not more often than that [s]
constexpr double kWorthReturning =
    40;  // of a flight that is left, to be planned anew [s]
constexpr double kOff = 15, kOffHeight = 8;  // what is expected counts as wrong [m]
constexpr double kClearanceShare = 0.5;  // of the height flown, kept clear at the most
constexpr double kOtherWind = 1;         // than that of the plan [m/s]
constexpr double kWrongWind = 2;     // of a flight out of the way: it is made anew [m/s]
constexpr double kWrongFor = 5;      // and this long after what is wanted was [s]
constexpr double kOffAgain = 10;     // of legs that are planned: anew, at the soonest [s]
constexpr double kUnplanned = 10;    // legs are flown after a plan was refused [s]
constexpr double kCourseAgain = 5;   // of who does not obey, at least so often [s]
constexpr double kMinCourse = 1;     // and not more often than that [s]
constexpr double kCourseError = 10;  // of a course that is no plan [m]
constexpr double kClimbsFor = 6;     // it may climb and sink on [s]
constexpr double kIgnored = 60;      // that a pilot counts as flying on [s]
constexpr double kMarginOfPilot = 1;    // after the slowest reaction [s]
constexpr double kPlannedRadius = 1.1;  // of the turn radius: room to correct
constexpr double kPlannedClimb = 0.95;  // of the climb rate, likewise

// Whether something is so far from where it is expected that this counts as wrong.
bool is_off(const Vec3& off) {
  return off.head<2>().norm() > kOff || std::abs(off.z()) > kOffHeight;
}

// The least height above the ground of a flight, and a little less [m].
double lowest(const FlightPlan& plan, const Terrain& ground) {
  constexpr double kLook = 5, kLess = 2;  // [s], [m]
  double least = math::kInfinity;
  const double end = model::end_time_of(plan);
  for (double time = model::start_of(plan); time < end + kLook; time += kLook) {
    const Vec3 p_N = model::moment_at(plan, std::min(time, end)).p_N;
    least = std::min(least, -p_N.z() - ground.elevation_msl(geo::horizontal(p_N)));
  }
  return std::max(0.0, least - kLess);
}

void end_with_milestone(WantedFlight& wanted) {
  const double end = model::end_time_of(wanted.plan);
  if (wanted.milestones.empty() || wanted.milestones.back() < end)
    wanted.milestones.push_back(end);
}

FlightPriority priority_of(const AutopilotStatus& status) {
  if (status.trigger != FailsafeTrigger::kNone) return FlightPriority::kEmergency;
  if (status.mode == FlightMode::kManual || status.mode == FlightMode::kStabilized)
    return FlightPriority::kPilotFlies;
  if (status.reserve < 0) return FlightPriority::kCannotManoeuvre;
  return FlightPriority::kNormal;
}

}  // namespace

void SeparationPlanner::listen(const AgentInput& in, AgentOutput& out) {
  if (options_.method == SeparationMethod::kNone) return;
  separator_.listen(in.now, in.inbox);
  landing_.listen(in, {separator_.loss(), separator_.delay()}, out);
}

PathQuery SeparationPlanner::query_of(const TaskStep& step) const {
  PathQuery query;
  query.limits = planning_limits(context_.limits, kPlannedRadius);
  // Climbs that begin at once are no curves that an autopilot can fly.
  if (query.limits.climb_acceleration <= 0)
    query.limits.climb_acceleration = kClimbAcceleration;
  query.limits.climb_rate *= kPlannedClimb;
  query.limits.sink_rate *= kPlannedClimb;
  query.wind = step.in.nav->wind_N;
  query.ground_clearance = std::min(kClearanceShare * context_.altitude_agl, lowest_);
  query.terrain = context_.map;
  return query;
}

// Whether the aircraft flies elsewhere than was expected, or further than that goes.
bool SeparationPlanner::expects_other(const FlightIntent& given,
                                      const TaskStep& step) const {
  if (!expected_ || by_others_ || given.number != given_ || given.what.index() != kind_)
    return true;
  const double age = (step.in.now - expected_at_).seconds();
  if (age >= kMinExpected && circles_elsewhere(given)) return true;
  if (legs_end_ && has_legs_ && must_move_hold(step.in.now)) return true;
  if (separator_.changed()) {
    // Near its end another flight could not come down in time to where this one ends.
    const double left = model::end_time_of(separator_.plan()) - step.in.now.seconds();
    if (left <= 0) return true;
    const Vec2 wind = separator_.plan().back().wind;
    if ((wind - step.in.nav->wind_N).norm() > kWrongWind && age > kWrongFor) return true;
    if (has_legs_) return separator_.is_clear(step.in.now) || left < options_.horizon;
    return separator_.is_clear(step.in.now) && left > kWorthReturning;
  }
  // Flights that were planned in another wind cannot be flown.
  const Vec2 wind = wanted_.plan.back().wind;
  const bool other_wind = (wind - step.in.nav->wind_N).norm() > kOtherWind;
  if (flies_as_expected_) {
    const double left = model::end_time_of(wanted_.plan) - step.in.now.seconds();
    return left < options_.horizon || (other_wind && age > kMinExpected) ||
           (step.safety.off_plan() && age > kOffAgain);
  }
  if (other_wind) return true;
  if (age < kMinExpected) return false;
  const Vec3 off =
      model::moment_at(wanted_.plan, step.in.now.seconds()).p_N - step.in.nav->p_N;
  return age > kExpectAgain || is_off(off);
}

// Whether what it circles has moved since that was planned: its intent has the same
// number.
bool SeparationPlanner::circles_elsewhere(const FlightIntent& given) const {
  const auto* circling = std::get_if<Circling>(&given.what);
  if (!circling || !circled_) return false;
  const double up =
      circling->altitude_msl.value_or(0) - circled_->altitude_msl.value_or(0);
  return (circling->centre - circled_->centre).norm() > kOff || std::abs(up) > kOffHeight;
}

void SeparationPlanner::want(const FlightIntent& given, const TaskStep& step,
                             const FlightProgress& flight) {
  if (const auto* itinerary = std::get_if<Itinerary>(&given.what)) {
    want_itinerary(given, *itinerary, step);
    return;
  }
  if (!std::holds_alternative<Legs>(given.what)) waits_for_ = 0;
  go_on_interrupting(given);
  if (const auto* legs = std::get_if<Legs>(&given.what))
    points_left_ = legs->points.size() * static_cast<std::size_t>(legs->laps);
  const bool flies = flight.number == given.number;
  const std::size_t passed = flies ? flight.passed : 0;
  if (flies && given.number == given_)
    reported_ = passed - std::min(passed_before_, passed);
  if (goes_on_as_foreseen(given) || !expects_other(given, step)) return;
  const bool has_legs = std::holds_alternative<Legs>(given.what);
  // Circles too are flown as they are said: autopilots each fly their own way onto one.
  const bool may_be_planned = has_legs || std::holds_alternative<Circling>(given.what);
  const PathQuery query = query_of(step);
  FlightContext context = context_;
  if (may_be_planned) context.limits = query.limits;
  ExpectedFlight ahead =
      expected_flight(given, passed, *step.in.nav, context, step.in.now.seconds(),
                      options_.horizon + kExpected);
  const bool stays = may_not_leave(ahead.plan, given, step);
  if (stays) ahead = prolonged(given, step, context);
  if (ahead.plan.empty()) return;
  const bool ends = stay_behind_legs(given, step, ahead);
  FlightCheck check(query, step.safety.zones().zones());
  const bool as_expected =
      may_be_planned && step.in.now >= unplanned_until_ && check.is_free(ahead.plan);
  if (stays && !as_expected) return;
  WantedFlight wanted{counted_ + 1, std::move(ahead.plan), ahead.points, as_expected};
  end_with_milestone(wanted);
  if (ends && as_expected) wanted.held_from = *ahead.stays_from;
  if (has_legs && as_expected && !begins(given, wanted, step)) return;
  wanted_ = std::move(wanted);
  ++counted_;
  flies_as_expected_ = as_expected;
  foreseen_ = false;
  legs_end_ = ends;
  points_ahead_ = ahead.points.size();
  reported_ = 0;
  passed_before_ = passed;
  has_legs_ = has_legs;
  given_ = given.number;
  kind_ = given.what.index();
  circled_.reset();
  if (const auto* circling = std::get_if<Circling>(&given.what)) circled_ = *circling;
  expected_ = true;
  by_others_ = false;
  expected_at_ = step.in.now;
}

// Whether a flight out of the way of others, which has not ended, may not be left for
// another yet.
bool SeparationPlanner::may_not_leave(const FlightPlan& plan, const FlightIntent& given,
                                      const TaskStep& step) const {
  const Time now = step.in.now;
  if (!expected_ || by_others_ || given.number != given_ || !separator_.changed() ||
      now.seconds() >= model::end_time_of(separator_.plan()))
    return false;
  return !separator_.is_clear(now) || plan.empty() || separator_.meets_others(plan, now);
}

// A flight out of the way of others, and the legs that are left from its end on: others
// have to see in time what comes then. Empty while that is far off.
ExpectedFlight SeparationPlanner::prolonged(const FlightIntent& given,
                                            const TaskStep& step,
                                            const FlightContext& context) const {
  const double now = step.in.now.seconds();
  const double end = model::end_time_of(separator_.plan());
  if (!has_legs_ || end - now >= options_.horizon) return {};
  const model::FlightMoment m = model::end_of(separator_.plan().back());
  NavEstimate there = *step.in.nav;
  there.p_N = m.p_N;
  there.v_N = m.v_N;
  there.heading = m.heading;
  const std::vector<double>& milestones = separator_.milestones();
  const std::size_t points =
      std::min(points_ahead_ - std::min(reported_, points_ahead_), milestones.size());
  ExpectedFlight on =
      expected_flight(given, points, there, context, end, options_.horizon + kExpected);
  ExpectedFlight all;
  all.plan = solve::part_of(separator_.plan(), now, end);
  all.plan.insert(all.plan.end(), on.plan.begin(), on.plan.end());
  all.points.assign(milestones.begin(),
                    milestones.begin() + static_cast<std::ptrdiff_t>(points));
  all.points.insert(all.points.end(), on.points.begin(), on.points.end());
  all.stays_from = on.stays_from;
  return all;
}

// While what it flies without a plan is interrupted, a task says at each step what is
// left of it: that is the same flight.
void SeparationPlanner::go_on_interrupting(const FlightIntent& given) {
  if (interrupted_ && expected_ && given_ != 0 && given.what.index() == kind_)
    given_ = given.number;
}

// Nobody on board knows what a pilot or a failsafe flies next.
void SeparationPlanner::want_course(const TaskStep& step) {
  waits_for_ = 0;
  const NavEstimate& nav = *step.in.nav;
  const double now = step.in.now.seconds(), age = now - expected_at_.seconds();
  if (by_others_) {
    const Vec3 off = model::moment_at(wanted_.plan, now).p_N - nav.p_N;
    if (age < kMinCourse || (!is_off(off) && age < kCourseAgain)) return;
  }
  FlightPlan plan =
      course_flight(nav.p_N, nav.v_N, now, options_.horizon + kExpected, kClimbsFor);
  if (plan.empty()) return;
  wanted_ = {++counted_, std::move(plan), {}, false, kCourseError};
  wanted_.milestones = {model::end_time_of(wanted_.plan)};
  foreseen_ = false;
  expected_ = by_others_ = true;
  expected_at_ = step.in.now;
}

void SeparationPlanner::want_itinerary(const FlightIntent& given,
                                       const Itinerary& itinerary, const TaskStep& step) {
  const bool same = !expected_ && given.number == given_ && counted_ > 0;
  if (same) return foresee_end(itinerary, step);
  WantedFlight wanted{counted_ + 1, itinerary.plan, itinerary.milestones, true};
  if (itinerary.over_ground)
    wanted.plan = at_height_over_ground(itinerary.plan, context_, context_.altitude_agl,
                                        step.in.nav->p_N.z());
  end_with_milestone(wanted);
  const std::size_t points = wanted.milestones.size();
  if (!begins(given, wanted, step)) return;
  wanted_ = std::move(wanted);
  ++counted_;
  task_points_ = points;
  points_before_ = 0;
  foreseen_ = legs_end_ = false;
  as_task_ = true;
  given_ = given.number;
  kind_ = given.what.index();
  expected_ = by_others_ = false;
  foresee_end(itinerary, step);
}

const FlightIntent* SeparationPlanner::plan(const FlightIntent* given,
                                            const TaskStep& step,
                                            const FlightProgress& flight,
                                            AgentOutput& out) {
  SKEIN_CHECK(given != nullptr);
  modifies_ = false;
  interrupted_ = std::exchange(interrupts_, false);
  reason_ = {};
  if (options_.method == SeparationMethod::kNone || step.in.autopilot.on_ground)
    return given;
  const FlightIntent* asked =
      landing_.plan(given, step, {separator_.loss(), separator_.delay()}, out);
  // The task has no part in it when another flight than its own is refused.
  if (flight.refused && own_number_ != 0 && flight.number == own_number_ &&
      (separator_.changed() || expected_)) {
    if (!separator_.changed())
      unplanned_until_ = step.in.now + Time::from_seconds(kUnplanned);
    separator_.refuse_plan();
    if (expected_) given_ = 0;  // expected anew, from here and in the wind that there is
  }
  const bool obeys = obeys_orders(step.in.autopilot);
  if (obeys && asked == given) asked = held(asked, step);
  if (obeys)
    want(*asked, step, flight);
  else
    want_course(step);
  modifies_ = asked != given;
  reason_ = landing_.reason();
  if (asked == &held_ && reason_.empty()) reason_ = "circles apart from others";
  if (wanted_.plan.empty()) return asked;
  separate(step, !obeys || landing_.approaches(), is_ignored(step, flight));
  say(out);
  if (!obeys) return asked;
  if (const std::string_view why = separator_.reason(); !why.empty()) reason_ = why;
  if (const auto& turn = separator_.turn()) {
    own_ = {0, Steering{HoldCourse{turn->course}, turn->course, turn->altitude_msl, {}}};
    own_number_ = 0;
    modifies_ = false;
    interrupts_ = true;
    return &own_;
  }
  if (waits_for_ != 0) {
    if (reason_.empty()) reason_ = "waits until others are out of the way";
    const FlightIntent* flown = own_flight(*asked, step);
    // The task plans again from where it is then.
    interrupts_ = step.in.now >= asks_again_;
    return flown;
  }
  if (expected_ && !separator_.changed() && !flies_as_expected_) return asked;
  return own_flight(*asked, step);
}

// Whether a pilot has not flown what was shown. Nobody may count with that flight then:
// the task's is flown.
bool SeparationPlanner::is_ignored(const TaskStep& step, const FlightProgress& flight) {
  const Time now = step.in.now;
  const bool unflown = separator_.changed() && own_number_ != 0 &&
                       flight.number != own_number_ && now >= ignored_until_;
  if (!unflown) {
    unflown_since_.reset();
    return now < ignored_until_;
  }
  if (!unflown_since_) unflown_since_ = now;
  if ((now - *unflown_since_).seconds() <= options_.reaction + kMarginOfPilot)
    return false;
  unflown_since_.reset();
  ignored_until_ = now + Time::from_seconds(kIgnored);
  separator_.refuse_plan();
  return true;
}

// Changes the flight that is wanted, if it has to be.
void SeparationPlanner::separate(const TaskStep& step, bool keeps_on, bool is_ignored) {
  messages_.clear();
  if (lowest_of_ != wanted_.number) {
    lowest_of_ = wanted_.number;
    lowest_ = lowest(wanted_.plan, *context_.map);
  }
  list_intruders(step);
  const PathQuery query = query_of(step);
  separator_.step(separation_step(step, query, keeps_on, is_ignored), wanted_, messages_);
}

SeparationStep SeparationPlanner::separation_step(const TaskStep& step,
                                                  const PathQuery& query, bool keeps_on,
                                                  bool is_ignored) const {
  FlightPriority priority = priority_of(step.in.autopilot);
  if (landing_.approaches()) priority = std::max(priority, FlightPriority::kLanding);
  if (step.in.now < ignored_until_)
    priority = std::max(priority, FlightPriority::kPilotFlies);
  return {step.in.now,
          step.in.nav->p_N,
          step.in.nav->v_N,
          step.in.nav->position_sd,
          step.in.nav->altitude_sd,
          priority,
          query,
          step.safety.zones().zones(),
          intruders_,
          keeps_on,
          is_ignored};
}

// The plan of the separator, to be flown in time.
const FlightIntent* SeparationPlanner::own_flight(const FlightIntent& given,
                                                  const TaskStep& step) {
  modifies_ = !expected_ || flies_as_expected_;
  // Who circles goes on with that in the end, wherever it has been led meanwhile.
  interrupts_ = expected_ && (has_legs_ || (separator_.changed() && !circles()));
  const bool as_task = as_task_ && !separator_.changed() && !expected_;
  // What follows has been added to what is said, or is another circle.
  const bool same_flight = own_as_task_ && as_task && own_of_ == given_;
  if (own_number_ != 0 && (own_plan_ == separator_.number() || same_flight)) return &own_;
  own_plan_ = separator_.number();
  own_as_task_ = as_task;
  own_of_ = given_;
  Itinerary own;
  if (const auto* itinerary = std::get_if<Itinerary>(&given.what)) own = *itinerary;
  own.over_ground = own.over_ground && as_task;
  if (!as_task) {
    own.plan = separator_.plan();
    own.milestones = separator_.milestones();
    // Shorter ones to where it leads, planned elsewhere, would lead through the others.
    own.rejoins = false;
  }
  own.in_time = true;
  own_ = {step.intents.next(), std::move(own)};
  own_number_ = own_.number;
  return &own_;
}

// Firm tracks of those who do not belong to the team.
void SeparationPlanner::list_intruders(const TaskStep& step) {
  intruders_.clear();
  for (const TrafficTrack& track : step.beliefs.traffic().tracks()) {
    if (!is_firm(track)) continue;
    const TrafficState state = track.filter.at(step.in.now);
    AvoidedIntruder intruder;
    intruder.name = track.number;
    intruder.time = step.in.now.seconds();
    intruder.p_N = state.p_N;
    intruder.v_N = state.v_N;
    intruder.horizontal_sd = state.horizontal_sd();
    intruder.vertical_sd = state.vertical_sd();
    intruder.horizontal_speed_sd = std::sqrt(std::max(state.vv(0, 0), state.vv(1, 1)));
    intruder.vertical_speed_sd = std::sqrt(std::max(0.0, state.vv(2, 2)));
    // Who keeps more to its own kind keeps that to intruders too.
    intruder.kept = larger(intruder.kept, options_.separation);
    intruders_.push_back(intruder);
  }
}

FlightProgress SeparationPlanner::for_task(const FlightProgress& flown) {
  if (own_number_ == 0 || flown.number != own_number_) return flown;
  FlightProgress progress = flown;
  if (expected_) {
    if (!interrupts_ || !has_legs_) return flown;
    // Points of legs, and of these what has been passed since the task was last told.
    const std::size_t passed =
        std::min(separator_.passed() + flown.passed, points_ahead_);
    progress = {};
    progress.number = given_;
    progress.passed = passed - std::min(reported_, passed);
    progress.done = progress.passed >= points_left_;
    reported_ = std::max(reported_, passed);
    return progress;
  }
  progress.number = given_;
  return separator_.changed() || !as_task_ ? progress_of_task(progress) : progress;
}

void SeparationPlanner::say(AgentOutput& out) {
  for (Message& message : messages_) out.outbox.push_back(std::move(message));
  for (ConflictReport& report : separator_.take_reports())
    out.records.emplace_back(std::move(report));
}

}  // namespace skein::reasoning
