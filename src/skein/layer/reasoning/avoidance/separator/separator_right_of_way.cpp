// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "skein/layer/reasoning/avoidance/encounter/plan_encounter.h"
#include "skein/layer/reasoning/avoidance/separator/separator.h"
#include "skein/layer/reasoning/avoidance/separator/separator_common.h"

// How the separator asks a higher one to give way where it finds no flight itself, and
// answers those that ask it.

namespace skein::reasoning {
namespace {

constexpr double kLookFurther =
    60;  // beyond the horizon, for the conflict that is meant [s]
constexpr std::string_view kAsAsked = "gives way as asked";

bool is_possible(const YieldRequest& request, double now, double horizon) {
  return std::isfinite(request.meets) && std::isfinite(request.apart) &&
         request.apart > now && request.meets <= request.apart &&
         request.apart < now + 10 * horizon;
}

}  // namespace

// The lowest of those that block the own plan and have the way; in a class of priority
// that is the highest number.
const Conflict* Separator::lowest_in_the_way(Time now) const {
  const Conflict* lowest = nullptr;
  FlightPriority priority = FlightPriority::kNormal;
  for (const Conflict& conflict : conflicts_) {
    const TeamFlight* other = team_.find(conflict.other);
    if (!other || !other->conforms(now) || has_way_over(*other, now)) continue;
    const bool lower = !lowest || other->priority < priority ||
                       (other->priority == priority && lowest->other < conflict.other);
    if (!lower) continue;
    lowest = &conflict;
    priority = other->priority;
  }
  return lowest;
}

// No flight was found around all higher ones.
void Separator::ask_to_yield(const SeparationStep& step) {
  const Conflict* conflict = lowest_in_the_way(step.now);
  const TeamFlight* other = conflict ? team_.find(conflict->other) : nullptr;
  // Whoever is of a higher class gives way to none of a lower one.
  if (!other || other->priority != priority_) return;
  YieldRequest request;
  request.own_plan = own_.number;
  request.other_plan = other->number;
  request.meets = static_cast<float>(conflict->encounter.begin);
  request.apart = static_cast<float>(conflict->encounter.end);
  right_of_way_.ask(step.now, other->who, request, 2 * other->delay + kAgentStep);
}

void Separator::hear_answer(Time now, EntityId from, const YieldAnswer& answer) {
  const bool before = right_of_way_.other_yields(from, now);
  right_of_way_.take(now, from, answer);
  if (!before && right_of_way_.other_yields(from, now))
    log_.solved(from, now, SeparationMethod::kPriority, "the other gives way as asked");
}

void Separator::answer(const SeparationStep& step, EntityId from,
                       const YieldRequest& request) {
  const TeamFlight* other = team_.find(from);
  // Its plan will come, and the request again.
  if (!other || other->number != request.own_plan) return;
  std::optional<bool> granted = right_of_way_.answer_to(step.now, from, request);
  if (!granted) {
    granted = gives_way_to(step, *other, request);
    right_of_way_.decide(from, request, *granted);
  }
  plan_is_new_ = plan_is_new_ || request.other_plan != own_.number;
  answers_.push_back({self_, from, 0, Time(), YieldAnswer{request.request, *granted}});
}

// Whether it changes its flight for who asks: if it is of no higher class, and there is a
// flight that keeps out of the way of all, so that no third one has to change its own.
bool Separator::gives_way_to(const SeparationStep& step, const TeamFlight& other,
                             const YieldRequest& request) {
  const bool can = request.other_plan == own_.number && flies_plan() && !keeps_on_ &&
                   !negotiation_ && !group_ && priority_ == other.priority &&
                   !flies_on(priority_) && other.conforms(step.now) &&
                   is_possible(request, step.now.seconds(), options_.horizon) &&
                   (options_.method == SeparationMethod::kAuto ||
                    options_.method == SeparationMethod::kPriority);
  if (!can) return false;
  const Separation separation = separation_of(own_, other);
  const double now = step.now.seconds();
  const auto encounter = first_encounter(own_.plan, other.plan, separation, now,
                                         now + options_.horizon + kLookFurther);
  if (!encounter || encounter->begin <= now) return false;
  const Conflict conflict{other.who, *encounter, separation};
  return around_others(step, conflict, false, kAsAsked) ||
         apart_from_others(step, conflict, false, kAsAsked);
}

}  // namespace skein::reasoning
