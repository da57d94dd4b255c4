// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "skein/data/team/mission.h"
#include "skein/role/agent.h"

namespace skein {

/// What a mission needs of the aircraft that it may have.
struct MissionDemand {
  int min = 1;                                ///< aircraft, without which it cannot go on
  int max = std::numeric_limits<int>::max();  ///< that it has a use for
  std::optional<Vec2> place = std::nullopt;   ///< where it is flown [m]; none: anywhere
};

/// What an operator wants of some aircraft, as a ground station pursues it.
///
/// At each step it is given the reports of all aircraft of the station; those that it has
/// not been allocated say in them that they do not obey. What it orders (Task) reaches
/// its own aircraft only; the station numbers orders and repeats them until they are
/// acknowledged. All other messages that the station receives are its too.
class Mission : public Agent {
 public:
  /// What it needs from now on. Asked once a step.
  virtual MissionDemand demand() const = 0;

  /// What it is to reach, as far as that can be measured from outside.
  virtual MissionGoal goal() const { return OpenGoal{}; }

  /// Grows when goal() changes while the mission runs.
  virtual std::uint32_t goal_number() const { return 0; }

  /// Nothing is left to do: its aircraft are free.
  virtual bool done() const { return false; }
};

}  // namespace skein
