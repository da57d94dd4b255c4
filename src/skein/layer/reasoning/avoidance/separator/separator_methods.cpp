// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "skein/layer/reasoning/avoidance/encounter/plan_encounter.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/evasive_flight.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/flight_check.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/replanned_flight.h"
#include "skein/layer/reasoning/avoidance/rules/rule_flight.h"
#include "skein/layer/reasoning/avoidance/separator/separator.h"
#include "skein/layer/reasoning/avoidance/separator/separator_common.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/repair.h"

// What each of two does alone: by priority, by rule, in evasion.

namespace skein::reasoning {
namespace {

constexpr double kBudget = 3;          // of negotiations, besides messages [s]
constexpr int kAttempts = 2;           // to negotiate, before one acts alone
constexpr double kLittleLoss = 0.1;    // of messages
constexpr double kLittleDelay = 1;     // of messages [s]
constexpr double kMinTimeToAct = 3;    // between an agreement and the conflict [s]
constexpr std::size_t kGroupFrom = 2;  // conflicts of one aircraft
constexpr double kApartFor = 150;      // after a manoeuvre's begin [s]
constexpr double kApartMore = 60;      // after the conflict that it is about [s]
constexpr double kRoom = 0.5;        // around others, so that none is met by rounding [m]
constexpr double kHeightRoom = 0.3;  // the same, up and down [m]
constexpr double kRoomTime = 0.1;    // the same, along [s]
constexpr double kNear = 3000;       // others that plans are made around [m]
constexpr double kEvades = 15, kBothEvade = 9;  // before a conflict [s]
constexpr std::size_t kFew = 3;                 // conflicts that are solved one by one
constexpr std::array kOwnStrengths = {1.0, 1.7, 3.0};

// Until when a flight because of a conflict has to be apart from others: the conflict
// itself may come long after its begin.
double apart_until(const Conflict& conflict, double begin) {
  return std::max(begin + kApartFor, conflict.encounter.end + kApartMore);
}

}  // namespace

// The row of the switch. Agreements cost least, so they are tried as long as one can
// still be reached, and again once; only then does one of the two act alone.
SeparationMethod Separator::method_for(const Conflict& conflict, Time now) const {
  if (options_.method != SeparationMethod::kAuto) return options_.method;
  const double left = conflict.encounter.begin - now.seconds();
  const double negotiating = kBudget + 4 * (2 * delay_to(conflict.other) + kAgentStep);
  const bool alone = conflicts_.size() < kGroupFrom;
  const TeamFlight* other = team_.find(conflict.other);
  const bool hears = other && other->conforms(now) && !flies_on(other->priority) &&
                     team_.loss() < kLittleLoss &&
                     delay_to(conflict.other) < kLittleDelay;
  if (left > options_.fixed + negotiating && hears)
    return alone ? SeparationMethod::kNegotiated : SeparationMethod::kGroup;
  const auto waiting = waiting_.find(conflict.other);
  const bool failed = waiting != waiting_.end() && waiting->second.failures >= kAttempts;
  if (left > negotiating + kMinTimeToAct && hears && !failed)
    return SeparationMethod::kNegotiated;
  if (left > options_.emergency) return SeparationMethod::kPriority;
  // Rules know of two only, and others hear late of what follows from them.
  if (left > options_.last_moment)
    return hears ? SeparationMethod::kRule : SeparationMethod::kPriority;
  return SeparationMethod::kLastMoment;
}

Standing Separator::standing_to(const TeamFlight& other, Time now) const {
  if (!other.conforms(now)) return Standing::kOtherHigher;
  if (priority_ == other.priority) return Standing::kEqual;
  return priority_ > other.priority ? Standing::kOwnHigher : Standing::kOtherHigher;
}

// Who is not where its plan has it flies on, whatever others do. In a class of priority
// it is the lower number, unless that has granted it to the other.
bool Separator::has_way_over(const TeamFlight& other, Time now) const {
  if (!other.conforms(now)) return false;
  if (priority_ != other.priority) return priority_ > other.priority;
  if (right_of_way_.yields_to(other.who, now)) return false;
  return self_ < other.who || right_of_way_.other_yields(other.who, now);
}

NegotiatedConflict Separator::about(const Conflict& conflict, double begin) const {
  NegotiatedConflict about;
  about.self = self_;
  about.other = conflict.other;
  about.begin = begin;
  about.meets = conflict.encounter.begin;
  about.closest = conflict.encounter.closest_time;
  about.apart = conflict.encounter.end;
  about.separation = conflict.separation;
  return about;
}

double Separator::begin_of_action(const Conflict& conflict, Time now) const {
  const double left = conflict.encounter.begin - now.seconds();
  return now.seconds() + std::min(options_.reaction, left / 2);
}

// The own plan, to be left because of a conflict and met again behind it.
NegotiatingFlight Separator::leaving_for(const Conflict& conflict,
                                         const PathQuery& query) const {
  return {own_.plan, rejoins(conflict.encounter.end + kRejoinsAfter), query.limits};
}

// Each by the rules of the air, whatever the other does.
bool Separator::by_rule(const SeparationStep& step, const Conflict& conflict) {
  const TeamFlight* other = team_.find(conflict.other);
  if (!other) return false;
  const double now = step.now.seconds(), left = conflict.encounter.begin - now;
  const TeamFlight::Expected expected = other->expected(step.now);
  if (!expected.plan) return false;
  const model::FlightMoment theirs = model::moment_at(*expected.plan, now);
  const AirRule rule = rule_for({step.p_N, step.v_N}, {theirs.p_N, theirs.v_N},
                                standing_to(*other, step.now), self_ < other->who);
  const bool late = left < options_.emergency && rule != AirRule::kPreferred;
  if (!acts(rule) && !late) return false;
  const double begin = begin_of_action(conflict, step.now);
  if (begin >= model::end_time_of(own_.plan)) return false;
  const NegotiatingFlight own = leaving_for(conflict, step.query);
  const NegotiatedConflict c = about(conflict, begin);
  const ConflictOfFlight of_flight{own_.plan, own.limits, c.begin,     c.meets,
                                   c.closest, c.apart,    c.separation};
  FlightCheck check(step.query, step.zones);
  const double until = apart_until(conflict, begin);
  const std::vector<KnownFlight> thirds = known_but(conflict.other, step.now);
  const auto fly = [&](bool among_others) {
    return flight_by_rule(
        rule, of_flight, [&](const Manoeuvre& m) { return flight_with(m, own, c); },
        [&](const FlightPlan& plan) {
          const auto meets = [&](const FlightPlan& flown, const Separation& kept) {
            return first_encounter(plan, flown, kept, begin, until).has_value();
          };
          if (meets(*expected.plan, c.separation)) return false;
          if (among_others && std::ranges::any_of(thirds, [&](const KnownFlight& third) {
                return meets(*third.plan, third.separation);
              }))
            return false;
          return check.is_free(plan);
        });
  };
  // The rules alone know of two only.
  std::optional<FlightPlan> flight;
  if (options_.method == SeparationMethod::kAuto) flight = fly(true);
  if (!flight) flight = fly(false);
  if (!flight) return false;
  adopt(*flight,
        {begin, own.rejoins, conflict.encounter.end, SeparationMethod::kRule,
         conflict.other, 0, name_of(rule)},
        step.now);
  return true;
}

// The lower one plans around the higher ones, and around the others too where it can.
bool Separator::by_priority(const SeparationStep& step, const Conflict& conflict) {
  const TeamFlight* other = team_.find(conflict.other);
  if (!other || has_way_over(*other, step.now)) return false;
  Waiting& waiting = waiting_[conflict.other];
  const double now = step.now.seconds();
  if (now < waiting.until) return false;
  for (const bool higher_only : {false, true})
    if (around_others(step, conflict, higher_only,
                      higher_only ? "gives way to higher ones" : "gives way"))
      return true;
  // A pair that no search parts: alone, one of the manoeuvres of negotiations.
  if (conflicts_.size() <= kFew && apart_from_others(step, conflict, true, {}))
    return true;
  ask_to_yield(step);
  waiting.until = now + 1;
  return false;
}

// The room that the others' plans own.
std::vector<PlannedFlight> Separator::rooms(const SeparationStep& step,
                                            bool higher_only) const {
  std::vector<PlannedFlight> all;
  for (const TeamFlight& each : team_.flights()) {
    const TeamFlight::Expected expected = each.expected(step.now);
    if (!expected.plan || (higher_only && has_way_over(each, step.now))) continue;
    const Vec3 p_N = model::moment_at(*expected.plan, step.now.seconds()).p_N;
    if ((p_N - step.p_N).head<2>().norm() > kNear) continue;
    const Separation separation = separation_of(own_, each, expected.unknown);
    PlannedFlight flight;
    flight.who = each.who;
    flight.plan = *expected.plan;
    flight.zone = {kRoomTime, kRoomTime, separation.horizontal + kRoom};
    flight.height = separation.vertical + kHeightRoom;
    all.push_back(std::move(flight));
  }
  return all;
}

bool Separator::around_others(const SeparationStep& step, const Conflict& conflict,
                              bool higher_only, std::string_view what) {
  const double begin = begin_of_action(conflict, step.now);
  const double until = rejoins(conflict.encounter.end + kRejoinsAfter);
  Airspace airspace;
  airspace.zones.assign(step.zones.begin(), step.zones.end());
  airspace.flights = rooms(step, higher_only);
  const auto flight = replanned(own_.plan, begin, until, step.query, airspace);
  if (!flight) return false;
  adopt(*flight,
        {begin, until, conflict.encounter.end, SeparationMethod::kPriority,
         conflict.other, 0, what},
        step.now);
  return true;
}

// The cheapest of the manoeuvres of a negotiation that needs nobody else to change.
// @param what  for the records; empty: the kind of the manoeuvre.
bool Separator::apart_from_others(const SeparationStep& step, const Conflict& conflict,
                                  bool higher_only, std::string_view what) {
  const double begin = begin_of_action(conflict, step.now);
  const NegotiatingFlight own = leaving_for(conflict, step.query);
  const NegotiatedConflict c = about(conflict, begin);
  std::vector<KnownFlight> others;
  for (const TeamFlight& each : team_.flights())
    if (const auto expected = each.expected(step.now);
        expected.plan && (!higher_only || !has_way_over(each, step.now)))
      others.push_back({expected.plan, separation_of(own_, each, expected.unknown)});
  const FlightPlan part = solve::part_of(own_.plan, begin, own.rejoins);
  if (part.empty()) return false;
  FlightCheck check(step.query, step.zones);
  const ConflictOfFlight of_flight{part,      own.limits, c.begin,     c.meets,
                                   c.closest, c.apart,    c.separation};
  const double until = apart_until(conflict, begin);
  for (const double strength : kOwnStrengths) {
    std::vector<Candidate> all = candidates(of_flight, strength, {}, until);
    std::ranges::stable_sort(all, {}, &Candidate::cost);
    for (const Candidate& each : all) {
      if (each.manoeuvre.kind == ManoeuvreKind::kGoOn) continue;
      const auto flight = flight_with(each.manoeuvre, own, c);
      if (!flight || std::ranges::any_of(others, [&](const KnownFlight& other) {
            return first_encounter(*flight, *other.plan, other.separation, begin, until)
                .has_value();
          }))
        continue;
      if (!check.is_free(*flight)) continue;
      adopt(*flight,
            {begin, own.rejoins, conflict.encounter.end, SeparationMethod::kPriority,
             conflict.other, 0, what.empty() ? name_of(each.manoeuvre.kind) : what},
            step.now);
      return true;
    }
  }
  return false;
}

// Puts off the encounter where none can be solved any more: the lower one of the two, and
// when little time is left each of them.
bool Separator::by_evasion(const SeparationStep& step, const Conflict& conflict) {
  const TeamFlight* other = team_.find(conflict.other);
  const double left = conflict.encounter.begin - step.now.seconds();
  if (!other || left > kEvades || (left > kBothEvade && has_way_over(*other, step.now)))
    return false;
  const double begin = begin_of_action(conflict, step.now);
  const NegotiatingFlight own = leaving_for(conflict, step.query);
  const FlightPlan part = solve::part_of(own_.plan, begin, own.rejoins);
  if (part.empty()) return false;
  FlightCheck check(step.query, step.zones);
  const std::vector<KnownFlight> others = known_but(self_, step.now);  // all others
  const PlanEncounter& encounter = conflict.encounter;
  auto evasive = evasive_flight(
      {part, own.limits, begin, std::max(begin, encounter.begin),
       std::max(begin, encounter.closest_time), std::max(begin, encounter.end),
       conflict.separation},
      others, [&](const FlightPlan& flight) { return check.is_free(flight); });
  if (!evasive) return false;
  append_rest(evasive->flight, own_.plan, own.rejoins);
  adopt(evasive->flight,
        {begin, own.rejoins, encounter.end, SeparationMethod::kPriority, conflict.other,
         0, "evades"},
        step.now);
  return true;
}

}  // namespace skein::reasoning
