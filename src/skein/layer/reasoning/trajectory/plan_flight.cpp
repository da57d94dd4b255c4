// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/plan_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/math.h"
#include "skein/layer/reasoning/trajectory/drape.h"
#include "skein/layer/reasoning/trajectory/plan_mending.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr double kLookAgain = 10;    // after the first failure to mend [s]
constexpr double kLongestWait = 60;  // after others [s]
constexpr double kCourseAhead = 3;   // whose bearing is the course of a plan [s]

constexpr double kOffPlan = 60;    // beside the plan it is flown towards, not along [m]
constexpr double kNextStep = 0.5;  // from now, when a task goes on [s]

}  // namespace

PlanFlight::PlanFlight(const Itinerary& itinerary, const FlightContext& context)
    : plan_(itinerary.plan),
      milestones_(itinerary.milestones),
      in_time_(itinerary.in_time),
      rejoins_(itinerary.rejoins),
      over_ground_(itinerary.over_ground),
      context_(context) {
  if (milestones_.empty() || milestones_.back() < model::end_time_of(plan_))
    milestones_.push_back(model::end_time_of(plan_));
  total_ = milestones_.size();
}

double PlanFlight::altitude_msl(double time) const {
  if (given_.empty()) return -model::moment_at(plan_, time).p_N.z();
  const auto next = std::lower_bound(
      given_.begin(), given_.end(), time,
      [](const PlanPoint& point, double t) { return point.time.seconds() < t; });
  return -(next == given_.end() ? given_.back() : *next).p_N.z();
}

void PlanFlight::step(const TrajectoryStep& step, AgentOutput& out) {
  const AgentInput& in = step.in;
  if (state_ != State::kNew && in.command_fate.state == CommandFate::State::kRefused)
    state_ = State::kRefused;
  if (state_ == State::kRefused) return;
  step.zones.regard(*in.nav, altitude_msl(in.now.seconds()));
  look(step, out);
  changed_ = changed_ || state_ == State::kMended || state_ == State::kBySight;
  if (state_ == State::kBySight) lead_by_sight(step, out);
}

// Whether the plan is still good, and what else to fly.
void PlanFlight::look(const TrajectoryStep& step, AgentOutput& out) {
  const AgentInput& in = step.in;
  const bool changed = step.zones.take_change(), first = state_ == State::kNew;
  const bool inside = step.zones.distance(geo::horizontal(in.nav->p_N)) < 0;
  const bool again = in.now >= look_again_;
  const bool off = step.off_plan && rejoins_ && again;
  const bool tries_again = state_ == State::kBySight && again && !inside;
  if (inside && state_ != State::kBySight) {
    state_ = State::kBySight;
    look_again_ = in.now;
    return;
  }
  if (inside || !(first || changed || off || tries_again)) return;
  if (!first) catch_up(in);
  const bool in_the_way = (first || changed || tries_again) && blocked(step);
  if (!in_the_way && !off && !tries_again) {
    if (!first) return;
    state_ = State::kAsPlanned;
    return give(step, out);
  }
  if (changed) wait_ = 0;
  wait_ = std::clamp(2 * wait_, kLookAgain, kLongestWait);
  look_again_ = in.now + Time::from_seconds(wait_);
  if (!mend(step, out)) {
    // Without zones there is nothing to be led around.
    state_ = step.zones.zones().empty() ? State::kAsPlanned : State::kBySight;
    if (first && state_ == State::kAsPlanned) give(step, out);
    return;
  }
  state_ = State::kMended;
  wait_ = 0;
  give(step, out);
}

// Moves the plan in time to where the aircraft is on it.
void PlanFlight::catch_up(const AgentInput& in) {
  if (!in.autopilot.follows || in_time_) return;
  const double behind = in.autopilot.time_error;
  plan_ = model::starting_at(std::move(plan_), model::start_of(plan_) + behind);
  for (double& time : milestones_) time += behind;
}

bool PlanFlight::blocked(const TrajectoryStep& step) const {
  if (step.zones.zones().empty()) return false;
  return comes_into_zone(plan_, step.in.now.seconds(), step, context_);
}

bool PlanFlight::mend(const TrajectoryStep& step, AgentOutput& out) {
  if (!context_.planner) return false;
  MendedPlan mended = mend_plan(plan_, milestones_, step, context_);
  if (mended.plan.empty()) {
    out.events.push_back({step.in.now, context_.self, EventKind::kNoPath, mended.reason});
    return false;
  }
  out.events.push_back({step.in.now, context_.self, EventKind::kPlanned, mended.reason});
  plan_ = std::move(mended.plan);
  milestones_ = std::move(mended.milestones);
  return true;
}

void PlanFlight::give(const TrajectoryStep& step, AgentOutput& out) {
  const AgentInput& in = step.in;
  if (over_ground_) {
    given_ = drape(plan_, *context_.map, context_.altitude_agl, context_.limits,
                   in.nav->p_N.z());
  } else {
    given_ = model::sample(plan_);
  }
  given_at_ = in.now;
  AutopilotCommand command;
  command.guidance = FollowPlan{given_};
  command.altitude_msl = altitude_msl(in.now.seconds());
  if (!in_time_) command.airspeed = context_.limits.airspeed;
  out.command = std::move(command);
}

// From the points that the autopilot was given, none of which are far apart in turns.
double PlanFlight::distance_to_plan(const Vec2& place) const {
  double least = math::kInfinity;
  for (std::size_t k = 1; k < given_.size(); ++k) {
    const Vec2 from = geo::horizontal(given_[k - 1].p_N);
    const Vec2 leg = geo::horizontal(given_[k].p_N) - from;
    const double length2 = leg.squaredNorm();
    const double share =
        length2 > 0 ? std::clamp((place - from).dot(leg) / length2, 0.0, 1.0) : 0;
    least = std::min(least, (from + share * leg - place).norm());
  }
  return least;
}

void PlanFlight::lead_by_sight(const TrajectoryStep& step, AgentOutput& out) {
  const NavEstimate& nav = *step.in.nav;
  const double now = step.in.now.seconds();
  if (given_.empty()) give(step, out);
  const Vec2 ahead =
      geo::horizontal(model::moment_at(plan_, now + kCourseAhead).p_N - nav.p_N);
  const double altitude = altitude_msl(now);
  const double course = geo::bearing(ahead);
  // Off the plan the autopilot would fly back to it, whatever course was judged here.
  const bool off = distance_to_plan(geo::horizontal(nav.p_N)) > kOffPlan;
  AutopilotCommand command;
  command.guidance = off ? step.zones.keep_out(HoldCourse{course}, course, nav, altitude)
                         : step.zones.keep_out(FollowPlan{given_}, course, nav, altitude);
  command.altitude_msl = altitude;
  if (!in_time_) command.airspeed = context_.limits.airspeed;
  out.command = std::move(command);
}

void PlanFlight::report(const AgentInput& in, FlightProgress& progress) const {
  const double now = in.now.seconds();
  const bool follows = in.autopilot.follows && in.now > given_at_;
  const double reached = in_time_ || !follows ? now : now - in.autopilot.time_error;
  progress.refused = state_ == State::kRefused;
  progress.by_sight = state_ == State::kBySight;
  progress.mended = changed_;
  const auto ahead = std::upper_bound(milestones_.begin(), milestones_.end(), reached);
  progress.passed = total_ - static_cast<std::size_t>(milestones_.end() - ahead);
  progress.time_to_go = std::max(0.0, milestones_.back() - reached);
  // What comes next is heard of a step later: by then the autopilot would circle.
  const bool all_but = follows && progress.time_to_go <= kNextStep;
  const bool over = progress.by_sight
                        ? progress.time_to_go == 0
                        : in.now > given_at_ && (in.autopilot.done || all_but);
  progress.done = over && state_ != State::kNew && !progress.refused;
  if (progress.done) progress.passed = total_;
}

std::string_view PlanFlight::change() const {
  switch (state_) {
    case State::kMended:
      return "left the plan around a zone, or joined it again";
    case State::kBySight:
      return "around zones by sight";
    case State::kRefused:
      return "the autopilot refuses the plan";
    case State::kNew:
    case State::kAsPlanned:
      break;
  }
  return {};
}

}  // namespace skein::reasoning
