// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/manoeuvre/evasive_flight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "skein/base/math.h"
#include "skein/geo/rotation.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr double kLookOn = 60;  // after `begin`: later encounters are solved later [s]
constexpr double kGain = 2;     // of time, for which the plan is left [s]
constexpr std::array kStrengths = {1.0, 1.7};
constexpr std::array kTurns = {20.0, 45.0, 80.0, 130.0};  // [deg]
constexpr std::array kTurnedFor = {5.0, 20.0};            // after the conflict [s]

struct Option {
  FlightPlan flight;
  double cost = 0;   // [s]
  double meets = 0;  // [s]
};

std::vector<Option> options_of(const ConflictOfFlight& conflict) {
  std::vector<Option> all;
  for (const double strength : kStrengths)
    for (Candidate& each : candidates(conflict, strength))
      if (each.manoeuvre.kind != ManoeuvreKind::kGoOn)
        all.push_back({std::move(each.flight), each.cost, 0});
  const double arrival = model::end_time_of(conflict.plan);
  for (const double turn : kTurns)
    for (const double side : {1.0, -1.0})
      for (const double more : kTurnedFor)
        if (auto flight = turned_flight(conflict, side * geo::radians(turn),
                                        conflict.apart + more)) {
          const double cost =
              std::abs(model::end_time_of(*flight) - arrival) + cost_of_climbs(*flight);
          all.push_back({*std::move(flight), cost, 0});
        }
  return all;
}

}  // namespace

std::optional<EvasiveFlight> evasive_flight(
    const ConflictOfFlight& conflict, std::span<const KnownFlight> others,
    const std::function<bool(const FlightPlan&)>& is_free) {
  if (conflict.plan.empty()) return std::nullopt;
  const double until = conflict.begin + kLookOn;
  std::vector<Option> all = options_of(conflict);
  FlightEnvelope room(conflict.begin, until);
  for (const Option& each : all) room.add(each.flight);
  const std::vector<KnownFlight> near = near_flights(room, others);
  for (Option& each : all) {
    each.meets = math::kInfinity;
    for (const KnownFlight& other : near)
      if (const auto encounter =
              first_encounter(each.flight, *other.plan, other.separation, conflict.begin,
                              std::min(until, each.meets)))
        each.meets = encounter->begin;
  }
  std::ranges::stable_sort(all, [](const Option& a, const Option& b) {
    return a.meets != b.meets ? a.meets > b.meets : a.cost < b.cost;
  });
  for (Option& each : all) {
    if (each.meets < conflict.meets + kGain) return std::nullopt;
    if (is_free(each.flight)) return EvasiveFlight{std::move(each.flight), each.meets};
  }
  return std::nullopt;
}

}  // namespace skein::reasoning
