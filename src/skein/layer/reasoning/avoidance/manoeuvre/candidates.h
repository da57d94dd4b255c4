// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "skein/data/traffic/separation.h"
#include "skein/layer/reasoning/avoidance/encounter/flight_envelope.h"
#include "skein/layer/reasoning/avoidance/encounter/plan_encounter.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/manoeuvred_flight.h"

namespace skein::reasoning {

/// A flight that somebody else has said it will fly.
struct KnownFlight {
  const FlightPlan* plan = nullptr;  ///< not null
  Separation separation;             ///< to be kept between it and the own aircraft
};

/// Those of some flights that may be met within the room of others, in their order.
std::vector<KnownFlight> near_flights(const FlightEnvelope& room,
                                      std::span<const KnownFlight> flights);

/// A manoeuvre that an aircraft can fly, and what it costs.
struct Candidate {
  Manoeuvre manoeuvre;
  FlightPlan flight;
  double cost = 0;  ///< [s]
};

/// What it costs a manoeuvre that it meets a third flight: 10^4 s where that is before
/// the conflict that it is about [s], 60 s within 30 s of it, 8 s later.
double cost_of_encounter(const PlanEncounter& encounter, double conflict);

/// What climbs cost: 0.05 s for each metre up or down [s].
double cost_of_climbs(const FlightPlan& flight);

/// What an aircraft may do about a conflict, with the cost of each:
///
///   |arrival - that of going on| + 0.05 s/m (metres up and down more than going on)
///     + cost_of_encounter() for each third flight that it meets until `look_until`.
///
/// @param others  flights of all but the two of the conflict.
/// Cost: a look at each of the others; those that may be met are compared with each.
std::vector<Candidate> candidates(const ConflictOfFlight& conflict, double strength,
                                  std::span<const KnownFlight> others, double look_until);

/// The same, with what encounter others costs still to come.
std::vector<Candidate> candidates(const ConflictOfFlight& conflict, double strength);

/// Adds that to the costs of candidates.
/// @returns  how many of the others may be met, and were compared with each.
std::size_t add_encounters(std::span<Candidate> all, const ConflictOfFlight& conflict,
                           std::span<const KnownFlight> others, double look_until);

}  // namespace skein::reasoning
