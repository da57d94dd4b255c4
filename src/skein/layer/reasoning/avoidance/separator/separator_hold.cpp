// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/layer/reasoning/avoidance/encounter/flight_envelope.h"
#include "skein/layer/reasoning/avoidance/encounter/plan_encounter.h"
#include "skein/layer/reasoning/avoidance/separator/separator.h"
#include "skein/layer/reasoning/avoidance/separator/separator_common.h"
#include "skein/model/path/flight_plan.h"

// Where an aircraft stays, and when it leaves that place for another flight.

namespace skein::reasoning {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kBudgetToBegin =
    5;                           // for an agreement, besides SeparationOptions::fixed [s]
constexpr double kNearBy = 400;  // of who circles; met within 15 s at most [m]
constexpr double kNearLevels = 4;  // the same, up and down, in vertical separations
constexpr int kDetours = 3;        // around others, one after the other, before it begins

}  // namespace

bool Separator::meets(const FlightPlan& plan, Time now, const Separation& more) const {
  FlightEnvelope room(now.seconds(), std::max(now.seconds(), model::end_time_of(plan)));
  room.add(plan);
  return std::ranges::any_of(known_but(self_, now), [&](const KnownFlight& other) {
    const Separation kept{other.separation.horizontal + more.horizontal,
                          other.separation.vertical + more.vertical};
    return room.may_meet(*other.plan, kept) &&
           first_encounter(plan, *other.plan, kept, now.seconds(), kInfinity);
  });
}

std::vector<HeldCircle> Separator::circles_of_others(Time now) const {
  std::vector<HeldCircle> all;
  for (const TeamFlight& each : team_.flights()) {
    if (!each.conforms(now)) continue;
    auto circle = circle_at_end(each.plan);
    if (!circle) continue;
    circle->separation = separation_of(own_, each);
    all.push_back(*circle);
  }
  return all;
}

bool Separator::has_neighbours_in_circles(Time now, const Vec3& p_N) const {
  return std::ranges::any_of(team_.flights(), [&](const TeamFlight& each) {
    if (!each.conforms(now)) return false;
    const Vec3 apart = model::moment_at(each.plan, now.seconds()).p_N - p_N;
    return apart.head<2>().norm() < kNearBy &&
           std::abs(apart.z()) < kNearLevels * options_.separation.vertical &&
           circle_at_end(each.plan);
  });
}

std::optional<double> Separator::is_to_move(Time now, bool behind_task) const {
  for (const Conflict& conflict : behind_task ? held_conflicts_ : conflicts_) {
    const TeamFlight* other = team_.find(conflict.other);
    if (other && !has_way_over(*other, now)) return conflict.encounter.begin;
  }
  return std::nullopt;
}

// Conflicts behind the end of what the task flies are solved by another place to stay at;
// others as if the flight ended there.
void Separator::set_held_conflicts_aside(Time now) {
  held_conflicts_.clear();
  if (now.seconds() >= held_from_) return;
  std::erase_if(conflicts_, [&](const Conflict& conflict) {
    if (conflict.encounter.begin < held_from_) return false;
    held_conflicts_.push_back(conflict);
    return true;
  });
  for (Conflict& each : conflicts_) {
    each.encounter.end = std::min(each.encounter.end, held_from_);
    each.encounter.closest_time = std::min(each.encounter.closest_time, held_from_);
  }
}

// The first conflict before `until` that would have to be solved at once: of those that
// the other solves only if that is left no time.
std::optional<Conflict> Separator::first_to_solve(const SeparationStep& step) const {
  ConflictFinder finder;
  const double now = step.now.seconds();
  const double soon = now + options_.fixed + kBudgetToBegin;
  for (const Conflict& conflict : finder.find(step.now, own_, team_.flights(), soon)) {
    const TeamFlight* other = team_.find(conflict.other);
    const bool waits = other && has_way_over(*other, step.now) &&
                       conflict.encounter.begin > now + options_.emergency;
    if (!waits) return conflict;
  }
  return std::nullopt;
}

Separator::FlyingState Separator::flying_state() const {
  return {own_,     wanted_,      agreed_,  milestones_, passed_,     changed_,
          is_plan_, plan_is_new_, unknown_, held_from_,  clear_from_, reason_};
}

void Separator::restore(const FlyingState& state) {
  own_ = state.own;
  wanted_ = state.wanted;
  agreed_ = state.agreed;
  milestones_ = state.milestones;
  passed_ = state.passed;
  changed_ = state.changed;
  is_plan_ = state.is_plan;
  plan_is_new_ = state.plan_is_new;
  unknown_ = state.unknown;
  held_from_ = state.held_from;
  clear_from_ = state.clear_from;
  reason_ = state.reason;
}

bool Separator::begins(const SeparationStep& step, const WantedFlight& wanted) {
  if (!begun_ || own_.plan.empty() || !flies_plan()) return true;
  if (negotiation_ || group_) return false;
  if (model::end_time_of(own_.plan) < step.now.seconds() + options_.emergency)
    return true;
  priority_ = step.priority;
  // Where it is now is no better.
  const auto here = first_to_solve(step);
  const FlyingState before = flying_state();
  want(wanted);
  for (int detours = 0;; ++detours) {
    const auto conflict = first_to_solve(step);
    if (!conflict || (here && here->encounter.begin <= conflict->encounter.begin))
      return true;
    if (detours == kDetours || conflict->encounter.begin >= held_from_ ||
        !around_others(step, *conflict, false, "begins around others"))
      break;
  }
  restore(before);
  return false;
}

}  // namespace skein::reasoning
