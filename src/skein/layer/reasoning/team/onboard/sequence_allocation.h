#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "skein/layer/reasoning/team/allocation/answer.h"
#include "skein/layer/reasoning/team/onboard/flight_conditions.h"
#include "skein/layer/reasoning/team/protocol/team_config.h"

namespace skein::reasoning {

/// Shares a team's tasks as sequences (AllocateTasks): each aircraft gets several, in the
/// order in which it flies them, so that the last one ends as soon as possible. Flights
/// between tasks count in the wind and around zones, and tasks that others come after.
///
/// An aircraft gets tasks for which it has the sensors, and as many as its endurance
/// allows with a reserve (kEnduranceReserve) and the way home. Who has begun a task ends
/// it first. Of a task for a group one aircraft counts. What waits for others' tasks is
/// planned, and given when these are over; at most kMaxGiven are given at once.
///
/// The utility is minus the time [s] until the last task ends, its bound what no answer
/// undercuts. A plan is kept unless another one is more than 5 % quicker, or an aircraft
/// or a new task has come or went. With many tasks it is looked for only then.
///
/// Reference: spec of the team, section 11; allocation/sequences.h.
class SequenceAllocation {
 public:
  static constexpr std::size_t kMaxGiven = 8;

  /// @param conditions  as its owner believes them to be now; outlives this.
  explicit SequenceAllocation(const FlightConditions& conditions)
      : conditions_(&conditions) {}

  TeamAllocated operator()(std::span<const TeamTask> open,
                           std::span<const TeamWorker> workers);

 private:
  struct Plan {
    TeamAllocation whole, flown;  // the latter: as much as the endurance allows
    allocation::Quality quality;  // of the whole, as a time [s]
  };
  Plan plan(std::span<const TeamTask> open, std::span<const TeamWorker> workers,
            bool is_new) const;

  const FlightConditions* conditions_;
  TeamAllocation whole_;           // the present plan
  std::set<EntityId> workers_;     // when it was last asked
  std::set<std::uint32_t> tasks_;  // likewise
};

}  // namespace skein::reasoning
