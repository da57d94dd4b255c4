// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "skein/layer/reasoning/avoidance/flights/conflicts.h"

namespace skein::reasoning {

/// Aircraft whose conflicts hang together: each has one with another of them.
struct ConflictGroup {
  std::vector<EntityId> others;  ///< ascending, without the own aircraft
  double apart = 0;              ///< the last of their conflicts is over then [s]
};

/// Finds the group that the own aircraft is in, from what the others have said they fly.
/// A pair is looked at once: again only when one of both plans has changed.
class ConflictGroups {
 public:
  /// Grows from the own conflicts, always by the conflict that begins first.
  /// @param conflicts  of the own aircraft, in order of time.
  /// @param until  conflicts that begin later do not count [s].
  /// @param most   members, the own aircraft included: where there are more, the later
  ///               conflicts stay outside.
  ConflictGroup find(Time now, std::span<const Conflict> conflicts,
                     std::span<const TeamFlight> others, double until, std::size_t most);

 private:
  struct Looked {
    std::uint32_t a = 0, b = 0;  // numbers of their plans
    std::optional<PlanEncounter> encounter;
  };
  using Pair = std::pair<EntityId, EntityId>;
  const std::optional<PlanEncounter>& encounter(const TeamFlight& a, const TeamFlight& b,
                                                double now);

  std::map<Pair, Looked> looked_;
};

}  // namespace skein::reasoning
