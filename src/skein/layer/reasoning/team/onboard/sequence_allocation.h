// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <span>

#include "skein/layer/reasoning/team/onboard/flight_conditions.h"
#include "skein/layer/reasoning/team/protocol/team_config.h"
#include "skein/solve/allocation/answer.h"

namespace skein::reasoning {

/// Shares a team's tasks as sequences (AllocateTasks): each aircraft gets several, in the
/// order in which it flies them, so that the last one ends as soon as possible, and of
/// the aircraft that do not end last the next one, and so on. Flights between tasks count
/// in the wind and around zones, and tasks that others come after.
///
/// An aircraft gets tasks for which it has the sensors, and as many as its endurance
/// allows with a reserve (kEnduranceReserve) and the way home. Who has begun a task ends
/// it first. What has no end is flown last, and only the first such counts. Of a task for
/// a group one aircraft counts. At most kMaxPlanned tasks are planned, those with the
/// lowest numbers that can be.
///
/// The utility is minus the time [s] until the last task with an end ends, its bound what
/// no answer undercuts. A plan is kept unless another one is more than 5 % quicker. With
/// many tasks another one is looked for only when an aircraft or a new task has come or
/// gone, or an aircraft has nothing left to do; in between the utility is not known.
///
/// Reference: spec of the team, section 11; allocation/sequences.h.
class SequenceAllocation {
 public:
  static constexpr std::size_t kMaxPlanned = 200;

  /// @param conditions  as its owner believes them to be now; outlives this.
  explicit SequenceAllocation(const FlightConditions& conditions)
      : conditions_(&conditions) {}

  TeamAllocated operator()(std::span<const TeamTask> open,
                           std::span<const TeamWorker> workers);

 private:
  bool must_plan(std::span<const TeamTask> open, std::span<const TeamWorker> workers,
                 bool is_new) const;
  /// @returns  how good the plan is, as a time [s].
  solve::Quality plan(std::span<const TeamTask> open,
                      std::span<const TeamWorker> workers);

  const FlightConditions* conditions_;
  TeamAllocation whole_;           // the present plan
  TeamAllocation flown_;           // of it, as much as the endurance allows
  std::set<EntityId> workers_;     // when it was last asked
  std::set<std::uint32_t> tasks_;  // likewise
};

}  // namespace skein::reasoning
