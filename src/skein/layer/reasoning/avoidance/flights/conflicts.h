// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "skein/layer/reasoning/avoidance/encounter/plan_encounter.h"
#include "skein/layer/reasoning/avoidance/flights/team_flights.h"

namespace skein::reasoning {

/// The own flight as it has been said to all.
struct OwnFlight {
  FlightPlan plan;
  std::uint32_t number = 0;
  Separation separation;                      ///< that is kept to others at least
  double across_error = 8, height_error = 2;  ///< [m]
};

/// Two planned flights that will not be apart.
struct Conflict {
  EntityId other;
  PlanEncounter encounter;
  Separation separation;  ///< of the pair
};

/// What two aircraft have to keep between their plans, so that they keep the larger
/// separation of both while each is off its plan as much as it has been of late:
///
///   D + e_i + e_j,  Z + z_i + z_j,  rounded up to half metres.
/// @param unknown  how far the other may be off what is expected, besides [m].
Separation separation_of(const OwnFlight& own, const TeamFlight& other,
                         double unknown = 0);

/// The same for two others.
Separation separation_between(const TeamFlight& a, const TeamFlight& b);

/// Finds the conflicts of the own flight with those of others. A pair is looked at once:
/// again only when one of both plans, or the separation, has changed.
///
/// Cost: of others whose flights are known already, a look into a table each; of another
/// own flight, mostly a box around each of theirs.
class ConflictFinder {
 public:
  /// The conflicts that begin before `until` [s], the earliest first. Only those flights
  /// count that conform, and of a pair the first conflict that is not over.
  std::vector<Conflict> find(Time now, const OwnFlight& own,
                             std::span<const TeamFlight> others, double until);

 private:
  struct Looked {
    EntityId who;
    std::uint32_t own = 0, other = 0;
    Separation separation;
    std::optional<PlanEncounter> encounter;
  };
  std::vector<Looked> looked_, before_;  // by id
};

}  // namespace skein::reasoning
