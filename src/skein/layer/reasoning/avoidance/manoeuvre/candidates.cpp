// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/manoeuvre/candidates.h"

#include <algorithm>
#include <cmath>

#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr double kPerMetre = 0.05;            // up or down [s/m]
constexpr double kEarlier = 1e4;              // encounter a third one [s]
constexpr double kSoon = 60, kSoonTime = 30;  // [s]
constexpr double kLater = 8;                  // [s]

// All metres up and down.
double climbed(const FlightPlan& plan) {
  double sum = 0;
  for (const FlightElement& e : plan) {
    const double end_rate = e.climb_rate + e.climb_acceleration * e.duration;
    if (e.climb_rate * end_rate >= 0) {
      sum += std::abs(e.climb_rate + end_rate) / 2 * e.duration;
      continue;
    }
    // It turns from climbing to sinking, or back, in between.
    const double turned = -e.climb_rate / e.climb_acceleration;
    sum += std::abs(e.climb_rate) * turned / 2 +
           std::abs(end_rate) * (e.duration - turned) / 2;
  }
  return sum;
}

}  // namespace

double cost_of_encounter(const PlanEncounter& encounter, double conflict) {
  if (encounter.begin < conflict) return kEarlier;
  return encounter.begin < conflict + kSoonTime ? kSoon : kLater;
}

double cost_of_climbs(const FlightPlan& flight) {
  return kPerMetre * climbed(flight);
}

std::vector<KnownFlight> near_flights(const FlightEnvelope& room,
                                      std::span<const KnownFlight> flights) {
  std::vector<KnownFlight> near;
  for (const KnownFlight& each : flights)
    if (room.may_meet(*each.plan, each.separation)) near.push_back(each);
  return near;
}

std::vector<Candidate> candidates(const ConflictOfFlight& conflict, double strength) {
  const auto going_on = manoeuvred({ManoeuvreKind::kGoOn}, conflict);
  if (!going_on) return {};
  std::vector<Candidate> all;
  for (const Manoeuvre& manoeuvre :
       manoeuvres(conflict.limits, conflict.separation, strength)) {
    auto flight = manoeuvred(manoeuvre, conflict);
    if (!flight) continue;
    const double cost =
        std::abs(model::end_time_of(*flight) - model::end_time_of(*going_on)) +
        std::max(0.0, cost_of_climbs(*flight) - cost_of_climbs(*going_on));
    all.push_back({manoeuvre, *std::move(flight), cost});
  }
  return all;
}

std::size_t add_encounters(std::span<Candidate> all, const ConflictOfFlight& conflict,
                           std::span<const KnownFlight> others, double look_until) {
  if (others.empty() || look_until <= conflict.begin) return 0;
  FlightEnvelope room(conflict.begin, look_until);
  for (const Candidate& each : all) room.add(each.flight);
  const std::vector<KnownFlight> near = near_flights(room, others);
  for (Candidate& each : all)
    for (const KnownFlight& other : near)
      if (const auto encounter = first_encounter(
              each.flight, *other.plan, other.separation, conflict.begin, look_until))
        each.cost += cost_of_encounter(*encounter, conflict.meets);
  return near.size();
}

std::vector<Candidate> candidates(const ConflictOfFlight& conflict, double strength,
                                  std::span<const KnownFlight> others,
                                  double look_until) {
  std::vector<Candidate> all = candidates(conflict, strength);
  add_encounters(all, conflict, others, look_until);
  return all;
}

}  // namespace skein::reasoning
