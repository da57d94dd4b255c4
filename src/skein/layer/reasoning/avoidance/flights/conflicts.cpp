// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/flights/conflicts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "skein/layer/reasoning/avoidance/encounter/flight_envelope.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

// By how much a pair's separation may have grown since its plans were looked at: how far
// each is off its plan changes all the time, and what was apart must not be changed for
// metres of it.
constexpr double kGrows = 3, kGrowsInHeight = 1;  // [m]

bool is_about(const Separation& now, const Separation& looked_at) {
  const auto within = [](double a, double b, double grows) {
    return a >= b - grows && a <= b + grows;
  };
  return within(now.horizontal, looked_at.horizontal, kGrows) &&
         within(now.vertical, looked_at.vertical, kGrowsInHeight);
}

double half_metres(double distance) {
  return std::ceil(2 * distance) / 2;
}

}  // namespace

Separation separation_of(const OwnFlight& own, const TeamFlight& other, double unknown) {
  const Separation pair = larger(own.separation, other.separation);
  return {half_metres(pair.horizontal + own.across_error + other.across_error + unknown),
          half_metres(pair.vertical + own.height_error + other.height_error)};
}

Separation separation_between(const TeamFlight& a, const TeamFlight& b) {
  return separation_of({{}, 0, a.separation, a.across_error, a.height_error}, b);
}

std::vector<Conflict> ConflictFinder::find(Time now, const OwnFlight& own,
                                           std::span<const TeamFlight> others,
                                           double until) {
  const double t = now.seconds();
  std::vector<Conflict> all;
  std::optional<FlightEnvelope> room;  // of the own flight
  const auto encounter = [&](const FlightPlan& other, const Separation& separation) {
    if (own.plan.empty() || model::end_time_of(own.plan) <= t)
      return std::optional<PlanEncounter>();
    if (!room) room.emplace(t, model::end_time_of(own.plan)).add(own.plan);
    if (!room->may_meet(other, separation)) return std::optional<PlanEncounter>();
    return first_encounter(own.plan, other, separation, t,
                           std::numeric_limits<double>::infinity());
  };
  std::swap(looked_, before_);
  looked_.clear();
  auto old = before_.begin();
  for (const TeamFlight& other : others) {
    while (old != before_.end() && old->who < other.who) ++old;
    const bool known = old != before_.end() && old->who == other.who;
    const TeamFlight::Expected expected = other.expected(now);
    if (!expected.plan) {
      if (known) looked_.push_back(*old);
      continue;
    }
    const Separation separation = separation_of(own, other, expected.unknown);
    const bool same = known && old->own == own.number && old->other == expected.number &&
                      is_about(separation, old->separation) &&
                      !(old->encounter && old->encounter->end <= t);
    looked_.push_back(same ? *old
                           : Looked{other.who, own.number, expected.number, separation,
                                    encounter(*expected.plan, separation)});
    const Looked& looked = looked_.back();
    if (looked.encounter && looked.encounter->begin < until)
      all.push_back({other.who, *looked.encounter, looked.separation});
  }
  std::ranges::stable_sort(all, {}, [](const Conflict& c) { return c.encounter.begin; });
  return all;
}

}  // namespace skein::reasoning
