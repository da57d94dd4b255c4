// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "skein/base/id.h"
#include "skein/geo/vec.h"
#include "skein/role/mission.h"

namespace skein {

/// An aircraft that can be allocated.
struct AllocatedAircraft {
  EntityId id;
  Vec2 place = Vec2::Zero();         ///< as last reported [m]
  std::optional<std::size_t> owner;  ///< index of the mission that has it now
};

/// A mission that wants aircraft.
struct WantingMission {
  MissionDemand demand;
  int priority = 0;                  ///< larger is more important
  std::vector<EntityId> candidates;  ///< who may fly it
};

/// Shares aircraft among missions.
class Allocator {
 public:
  virtual ~Allocator() = default;

  /// @returns  for each aircraft the index of its mission; none: it is free.
  virtual std::vector<std::optional<std::size_t>> allocate(
      const std::vector<AllocatedAircraft>& aircraft,
      const std::vector<WantingMission>& missions) const = 0;
};

}  // namespace skein
