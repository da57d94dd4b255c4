// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/separator/separator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/base/math.h"
#include "skein/layer/reasoning/avoidance/encounter/flight_envelope.h"
#include "skein/layer/reasoning/avoidance/separator/separator_common.h"
#include "skein/model/path/flight_code.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/repair.h"

namespace skein::reasoning {
namespace {

constexpr double kLookPeriod = 1;      // [s]
constexpr double kMeasurePeriod = 1;   // [s]
constexpr double kPlanPeriod = 5;      // of plans, in those of places
constexpr double kSigmas = 3;          // of where an aircraft believes to be
constexpr double kRepeatPeriod = 0.5;  // of a plan that is new, in periods of places
constexpr int kMaxRepeats = 14;
constexpr double kUnheard = 0.05;   // by so many is a new plan at most
constexpr int kMaxChanges = 3;      // of the plan in one look
constexpr double kSameTime = 1e-3;  // of a milestone, as sent in single precision [s]

// How often another plan is said again, so that nearly all hear of it at once. Where the
// air is narrow more would only lose more.
int times_again(double loss, double place_period) {
  const int most = static_cast<int>(kMaxRepeats / (place_period * place_period));
  int times = 0;
  for (double unheard = loss; unheard > kUnheard && times < most; unheard *= loss)
    ++times;
  return times;
}

float half_metres(double error) {
  return static_cast<float>(std::ceil(2 * error) / 2);
}

}  // namespace

void Separator::listen(Time now, std::span<const Message> inbox) {
  team_.listen(self_, now, inbox);
  for (const Message& message : inbox)
    if (std::holds_alternative<ConflictNotice>(message.content) ||
        std::holds_alternative<Offers>(message.content) ||
        std::holds_alternative<Acceptance>(message.content) ||
        std::holds_alternative<Busy>(message.content) ||
        std::holds_alternative<GroupInvitation>(message.content) ||
        std::holds_alternative<GroupJoining>(message.content) ||
        std::holds_alternative<GroupPlan>(message.content) ||
        std::holds_alternative<GroupAcceptance>(message.content) ||
        std::holds_alternative<YieldRequest>(message.content) ||
        std::holds_alternative<YieldAnswer>(message.content))
      inbox_.push_back(message);
}

// Takes what its task has it fly, rounded to what can be sent.
void Separator::want(const WantedFlight& wanted) {
  if (begun_ && wanted.number == wanted_) return;
  begun_ = true;
  wanted_ = wanted.number;
  is_plan_ = wanted.is_plan;
  unknown_ = wanted.unknown;
  held_from_ = wanted.held_from;
  own_.plan = model::as_sent(wanted.plan);
  ++own_.number;
  milestones_ = wanted.milestones;
  passed_ = 0;
  agreed_ = 0;
  changed_ = false;
  plan_is_new_ = true;
  if (flies_plan()) reason_ = {};
  negotiation_.reset();
  leave_group();
}

void Separator::step(const SeparationStep& step, const WantedFlight& wanted,
                     std::vector<Message>& out) {
  want(wanted);
  if (step.now.seconds() >= held_from_)
    held_from_ = std::numeric_limits<double>::infinity();
  priority_ = step.priority;
  keeps_on_ = step.keeps_on || step.is_ignored;
  own_.separation = options_.separation;
  measure(step);
  hear(step);
  negotiate(step);
  look(step);
  open_earliest(step);
  open_group(step);
  negotiate(step);
  right_of_way_.step(step.now, answers_);
  avoid_intruders(step);
  inbox_.clear();
  say(step, out);
}

// How well the plan is kept.
void Separator::measure(const SeparationStep& step) {
  const double now = step.now.seconds();
  if ((step.now - measured_).seconds() < kMeasurePeriod) return;
  measured_ = step.now;
  if (flies_plan() && (is_plan_ || changed_) && now >= model::start_of(own_.plan) &&
      now <= model::end_time_of(own_.plan))
    errors_.add(step.now, model::moment_at(own_.plan, now).p_N - step.p_N);
  own_.across_error = own_.height_error = 0;
  if (options_.widens) {
    // How it keeps to its plan and what it believes are wrong independently.
    own_.across_error =
        half_metres(math::hypot(errors_.across(), kSigmas * step.position_sd));
    own_.height_error =
        half_metres(math::hypot(errors_.height(), kSigmas * step.altitude_sd));
  }
  own_.across_error += unknown_;
  for (const Conflict& conflict : conflicts_) {
    const TeamFlight* other = team_.find(conflict.other);
    if (!other || !other->place) continue;
    const double age = (step.now - other->place->sent).seconds();
    const Vec3 apart = other->place->p_N + other->place->v_N * age - step.p_N;
    const Separation kept = larger(options_.separation, other->separation);
    log_.flown(conflict.other, kept.ratio(apart.head<2>().norm(), std::abs(apart.z())));
  }
}

// Looks for conflicts, and does what is to be done about each.
void Separator::look(const SeparationStep& step) {
  if ((step.now - looked_).seconds() < kLookPeriod && looked_ != Time()) return;
  looked_ = step.now;
  const double until = step.now.seconds() + options_.horizon;
  for (int changes = 0; changes < kMaxChanges; ++changes) {
    conflicts_ = finder_.find(step.now, own_, team_.flights(), until);
    set_held_conflicts_aside(step.now);
    log_.see(step.now, conflicts_);
    bool solved = false;
    for (const Conflict& conflict : conflicts_) {
      solved = solve(step, conflict);
      if (solved) break;
    }
    if (!solved) break;
  }
}

// @returns whether the own plan is another one now.
bool Separator::solve(const SeparationStep& step, const Conflict& conflict) {
  if (!flies_plan() || keeps_on_) return false;
  switch (method_for(conflict, step.now)) {
    case SeparationMethod::kNegotiated:  // open_earliest()
    case SeparationMethod::kGroup:       // open_group()
      return false;
    case SeparationMethod::kPriority:
      return by_priority(step, conflict) || by_evasion(step, conflict);
    case SeparationMethod::kRule:
      return by_rule(step, conflict);
    case SeparationMethod::kLastMoment:
      return by_evasion(step, conflict) ||
             (step.now >= last_moment_until_ && at_the_last_moment(step, conflict));
    case SeparationMethod::kNonCooperative:  // avoid_intruders()
    case SeparationMethod::kNone:
    case SeparationMethod::kAuto:
      break;
  }
  return false;
}

// Flies another way from `begin` on; what comes after `rejoins` as much later.
void Separator::adopt(const FlightPlan& flight, const Change& change, Time now) {
  const double old_end = model::end_time_of(own_.plan);
  FlightPlan plan = solve::part_of(
      own_.plan, std::max(now.seconds(), model::start_of(own_.plan)), change.begin);
  plan.insert(plan.end(), flight.begin(), flight.end());
  const double later = model::end_time_of(flight) - old_end;
  std::vector<double> milestones;
  for (const double time : milestones_) {
    if (time > now.seconds() && time <= change.begin)
      milestones.push_back(time);
    else if (time >= change.rejoins - kSameTime)
      milestones.push_back(time + later);
  }
  if (held_from_ >= change.rejoins - kSameTime) held_from_ += later;
  passed_ += milestones_.size() - milestones.size();
  milestones_ = std::move(milestones);
  own_.plan = model::as_sent(std::move(plan));
  ++own_.number;
  agreed_ = change.agreed;
  changed_ = plan_is_new_ = true;
  reason_ = change.what;
  clear_from_ = change.apart + kClearTime;
  if (change.other) log_.solved(*change.other, now, change.method, change.what);
  if (negotiation_ && negotiation_->state() == PairNegotiation::State::kOpen)
    negotiation_.reset();
  leave_group();
}

void Separator::say(const SeparationStep& step, std::vector<Message>& out) {
  for (Message& message : answers_) {
    log_.sent(message.to, coded_size(message));
    out.push_back(std::move(message));
  }
  answers_.clear();
  const double place_period = options_.place_period;
  if ((step.now - said_place_).seconds() >= place_period || said_place_ == Time()) {
    said_place_ = step.now;
    PlaceReport place;
    place.north = static_cast<float>(step.p_N.x());
    place.east = static_cast<float>(step.p_N.y());
    place.down = static_cast<float>(step.p_N.z());
    place.v_north = static_cast<float>(step.v_N.x());
    place.v_east = static_cast<float>(step.v_N.y());
    place.v_down = static_cast<float>(step.v_N.z());
    place.plan = flies_plan() ? own_.number : 0;
    out.push_back({self_, kEveryone, 0, Time(), place});
  }
  if (!flies_plan()) return;
  const double said_ago = (step.now - said_plan_).seconds();
  const bool again = said_again_ > 0 && said_ago >= kRepeatPeriod * place_period;
  if (!plan_is_new_ && !again && said_ago < kPlanPeriod * place_period) return;
  const double from = std::max(step.now.seconds(), model::start_of(own_.plan));
  if (from >= model::end_time_of(own_.plan)) return;
  auto coded = model::coded_flight(own_.plan);
  if (!coded) return;
  said_plan_ = step.now;
  said_again_ = plan_is_new_ ? times_again(team_.loss_to_expect(), place_period)
                             : std::max(0, said_again_ - 1);
  plan_is_new_ = false;
  PlanReport report;
  report.number = own_.number;
  report.agreed = agreed_;
  report.priority = priority_;
  report.horizontal = static_cast<float>(options_.separation.horizontal);
  report.vertical = static_cast<float>(options_.separation.vertical);
  report.across_error = static_cast<float>(own_.across_error);
  report.height_error = static_cast<float>(own_.height_error);
  report.flight = *std::move(coded);
  out.push_back({self_, kEveryone, 0, Time(), std::move(report)});
}

// Where the plan must be met again after a time.
double Separator::rejoins(double after) const {
  // What the task flies is flown to its end.
  if (after >= held_from_ && held_from_ < model::end_time_of(own_.plan))
    return held_from_;
  const auto found = std::ranges::upper_bound(milestones_, after);
  return found != milestones_.end() ? std::min(*found, model::end_time_of(own_.plan))
                                    : model::end_time_of(own_.plan);
}

double Separator::delay() const {
  double longest = 0;
  for (const TeamFlight& each : team_.flights()) longest = std::max(longest, each.delay);
  return longest;
}

double Separator::delay_to(EntityId other) const {
  const TeamFlight* flight = team_.find(other);
  return flight ? flight->delay : 0;
}

bool Separator::meets_others(const FlightPlan& plan, Time now) const {
  const double from = now.seconds(), until = from + options_.horizon;
  FlightEnvelope room(from, std::min(until, model::end_time_of(plan)));
  room.add(plan);
  return std::ranges::any_of(known_but(self_, now), [&](const KnownFlight& other) {
    return room.may_meet(*other.plan, other.separation) &&
           first_encounter(plan, *other.plan, other.separation, from, until);
  });
}

std::vector<KnownFlight> Separator::known_but(EntityId other, Time now) const {
  std::vector<KnownFlight> known;
  for (const TeamFlight& each : team_.flights())
    if (const auto expected = each.expected(now); each.who != other && expected.plan)
      known.push_back({expected.plan, separation_of(own_, each, expected.unknown)});
  return known;
}

}  // namespace skein::reasoning
