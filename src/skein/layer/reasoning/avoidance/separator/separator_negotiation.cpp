// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/layer/reasoning/avoidance/encounter/flight_envelope.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/flight_check.h"
#include "skein/layer/reasoning/avoidance/separator/separator.h"
#include "skein/layer/reasoning/avoidance/separator/separator_common.h"
#include "skein/model/path/flight_plan.h"

// How the separator negotiates: who opens, who answers, and what comes of it.

namespace skein::reasoning {
namespace {

constexpr double kLookOn = 60;  // beyond the horizon, for encounters that count [s]
constexpr double kMinTime = 1;  // between a manoeuvre's begin and the conflict [s]

bool makes_sense(const ConflictNotice& notice, double now, double horizon) {
  const auto near = [&](float time) {
    return std::isfinite(time) && time > now - horizon && time < now + 10 * horizon;
  };
  return near(notice.begin) && near(notice.meets) && near(notice.closest) &&
         near(notice.apart) && notice.begin < notice.meets &&
         notice.meets <= notice.closest && notice.closest <= notice.apart &&
         notice.horizontal > 0 && std::isfinite(notice.horizontal) &&
         notice.vertical > 0 && std::isfinite(notice.vertical);
}

}  // namespace

PairNegotiation* Separator::negotiation_of(EntityId opener, std::uint32_t number,
                                           EntityId other) {
  for (auto* each : {&negotiation_, &last_})
    if (*each && (*each)->conflict().name == NegotiationName{opener, number} &&
        (*each)->conflict().other == other)
      return &**each;
  return nullptr;
}

// Takes in what others say about negotiations.
void Separator::hear(const SeparationStep& step) {
  for (const Message& message : inbox_) {
    if (const auto* notice = std::get_if<ConflictNotice>(&message.content)) {
      answer(step, message.from, *notice);
    } else if (const auto* offers = std::get_if<Offers>(&message.content)) {
      PairNegotiation* about =
          negotiation_of(offers->opener, offers->negotiation, message.from);
      if (about && about->state() == PairNegotiation::State::kOpen)
        about->take(*offers);
      else if (about)
        about->say_again(answers_);
    } else if (const auto* acceptance = std::get_if<Acceptance>(&message.content)) {
      if (PairNegotiation* about =
              negotiation_of(acceptance->opener, acceptance->negotiation, message.from))
        about->take(*acceptance);
    } else if (const auto* busy = std::get_if<Busy>(&message.content)) {
      PairNegotiation* about =
          negotiation_of(busy->opener, busy->negotiation, message.from);
      if (about) about->refuse(busy->other_plan ? "plans have changed" : "busy");
      plan_is_new_ = plan_is_new_ || (about && busy->other_plan);
    } else if (const auto* request = std::get_if<YieldRequest>(&message.content)) {
      answer(step, message.from, *request);
    } else if (const auto* yields = std::get_if<YieldAnswer>(&message.content)) {
      hear_answer(step.now, message.from, *yields);
    } else {
      hear_of_groups(step, message);
    }
  }
}

// Whether a negotiation that another opens can go on; else why not.
bool Separator::can_answer(const SeparationStep& step, const ConflictNotice& notice,
                           const TeamFlight* other, Busy& busy) {
  const bool same_plans =
      other && notice.own_plan == other->number && notice.other_plan == own_.number;
  busy.other_plan = !same_plans;
  // The opener does not know the own plan yet.
  plan_is_new_ = plan_is_new_ || notice.other_plan != own_.number;
  const double now = step.now.seconds();
  return same_plans && !negotiation_ && !group_ && flies_plan() &&
         makes_sense(notice, now, options_.horizon) && notice.begin > now &&
         notice.meets < held_from_ && notice.begin < model::end_time_of(own_.plan) &&
         !keeps_on_ && !flies_on(priority_) &&
         (options_.method == SeparationMethod::kAuto ||
          options_.method == SeparationMethod::kNegotiated);
}

void Separator::answer(const SeparationStep& step, EntityId from,
                       const ConflictNotice& notice) {
  if (negotiation_of(from, notice.negotiation, from)) return;
  const TeamFlight* other = team_.find(from);
  Busy busy{from, notice.negotiation};
  if (can_answer(step, notice, other, busy))
    begin_negotiation(step, notice, from, *other);
  else
    answers_.push_back({self_, from, 0, Time(), busy});
}

void Separator::begin_negotiation(const SeparationStep& step,
                                  const ConflictNotice& notice, EntityId opener,
                                  const TeamFlight& other) {
  NegotiatedConflict conflict;
  conflict.self = self_;
  conflict.other = other.who;
  conflict.name = {opener, notice.negotiation};
  conflict.begin = notice.begin;
  conflict.meets = notice.meets;
  conflict.closest = notice.closest;
  conflict.apart = notice.apart;
  conflict.separation = {notice.horizontal, notice.vertical};
  conflict.look_until = notice.begin + options_.horizon + kLookOn;
  conflict.delay = other.delay;
  conflict.deal = options_.deal;
  const NegotiatingFlight own{own_.plan, rejoins(notice.apart + kRejoinsAfter),
                              step.query.limits};
  const NegotiatingFlight theirs{other.plan, model::end_time_of(other.plan), {}};
  negotiation_.emplace(conflict, own, theirs, step.now);
  if (opener == self_) negotiation_->set_notice(notice);
}

// Opens a negotiation about the earliest conflict that can be negotiated.
void Separator::open_earliest(const SeparationStep& step) {
  if (!flies_plan() || group_ || keeps_on_) return;
  for (const Conflict& conflict : conflicts_)
    if (!negotiation_ &&
        method_for(conflict, step.now) == SeparationMethod::kNegotiated &&
        open(step, conflict))
      return;
}

// Whether the other of a conflict has none before it with a third, which it will want to
// solve first: without that, chains of aircraft wait for each other. After some time it
// is asked all the same.
bool Separator::is_next_for(const TeamFlight& other, const Conflict& conflict, Time now) {
  Waiting& waiting = waiting_[other.who];
  if (waiting.seen_plan != other.number || waiting.own_plan != own_.number) {
    waiting.seen_plan = other.number;
    waiting.own_plan = own_.number;
    waiting.asks_at = now.seconds() + kAskAnyway;
  }
  if (now.seconds() >= waiting.asks_at) return true;
  const double until = conflict.encounter.begin;
  FlightEnvelope room(now.seconds(), until);
  room.add(other.plan);
  for (const TeamFlight& third : team_.flights()) {
    if (third.who == other.who || !third.conforms(now)) continue;
    const Separation kept = separation_between(other, third);
    if (room.may_meet(third.plan, kept) &&
        first_encounter(other.plan, third.plan, kept, now.seconds(), until))
      return false;
  }
  return true;
}

// Opens one about a conflict where that is up to this aircraft.
bool Separator::open(const SeparationStep& step, const Conflict& conflict) {
  const TeamFlight* other = team_.find(conflict.other);
  if (!other || !(self_ < conflict.other)) return false;
  const double now = step.now.seconds();
  if (const auto found = waiting_.find(conflict.other);
      found != waiting_.end() && now < found->second.until)
    return false;
  if (!is_next_for(*other, conflict, step.now)) return false;
  const double begin = now + options_.reaction + 3 * other->delay;
  if (begin + kMinTime > conflict.encounter.begin ||
      begin >= model::end_time_of(own_.plan) || begin >= model::end_time_of(other->plan))
    return false;
  const PlanEncounter& encounter = conflict.encounter;
  const ConflictNotice notice{++opened_,
                              own_.number,
                              other->number,
                              static_cast<float>(begin),
                              static_cast<float>(encounter.begin),
                              static_cast<float>(encounter.closest_time),
                              static_cast<float>(encounter.end),
                              static_cast<float>(conflict.separation.horizontal),
                              static_cast<float>(conflict.separation.vertical)};
  if (!makes_sense(notice, now, options_.horizon)) return false;
  begin_negotiation(step, notice, self_, *other);
  return true;
}

// Goes on with the negotiation that there is.
void Separator::negotiate(const SeparationStep& step) {
  negotiate_group(step);
  if (!negotiation_) return;
  const NegotiatedConflict& conflict = negotiation_->conflict();
  const TeamFlight* other = team_.find(conflict.other);
  if (other && other->agreed == code_of(conflict.name)) negotiation_->other_flies_it();
  FlightCheck check(step.query, step.zones);
  const std::vector<KnownFlight> known = known_but(conflict.other, step.now);
  negotiation_->step(
      step.now, {known, [&](const FlightPlan& flight) { return check.is_free(flight); }},
      answers_);
  if (negotiation_->state() == PairNegotiation::State::kOpen) return;
  PairNegotiation over = *std::move(negotiation_);
  negotiation_.reset();
  Waiting& waiting = waiting_[over.conflict().other];
  if (over.state() == PairNegotiation::State::kFailed) {
    waiting.until = step.now.seconds() + kOpenAgain;
    ++waiting.failures;
    return;
  }
  waiting = {};
  const NegotiatedConflict& agreed = over.conflict();
  const Change change{agreed.begin,
                      over.rejoins(),
                      agreed.apart,
                      SeparationMethod::kNegotiated,
                      agreed.other,
                      code_of(agreed.name),
                      name_of(over.manoeuvre().kind)};
  adopt(over.flight(), change, step.now);
  last_ = std::move(over);
}

}  // namespace skein::reasoning
