// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "skein/base/id.h"
#include "skein/layer/reasoning/team/onboard/flight_conditions.h"
#include "skein/layer/reasoning/team/protocol/team_config.h"
#include "skein/solve/allocation/coalitions.h"

namespace skein::reasoning {

/// Shares a team's tasks as coalitions of the highest utility (AllocateTasks): which
/// aircraft does which task, one at a time, with what they need in the wind and around
/// zones.
///
///   utility = sum over tasks of ( satisfaction(group) - sum of its members' costs )
///
/// One aircraft satisfies a task by min(1.5, endurance / (1.2 time needed)), the time to
/// come home included, by nothing below 1 or without the sensors that it takes; by a
/// tenth more where it hovers over the one place that the task is about. A group's task
/// is worth the root of how many are able. Joining costs the time to where the task
/// begins over 1.01 times the longest one. Who executes a task already has 5 % more of
/// it, and as much more as it has done: nobody begins where it left; and it counts as
/// near as it has been to the begin. The present allocation is kept unless another one is
/// more than 5 % better, or better and has fewer aircraft idle, or a task or an aircraft
/// came or went.
///
/// Reference: spec of the team, section 11; allocation/coalitions.h.
class CoalitionAllocation {
 public:
  /// @param conditions  as its owner believes them to be now; outlives this.
  explicit CoalitionAllocation(const FlightConditions& conditions)
      : conditions_(&conditions) {}

  TeamAllocated operator()(std::span<const TeamTask> open,
                           std::span<const TeamWorker> workers);

 private:
  using Executed = std::pair<EntityId, std::uint32_t>;
  solve::CoalitionProblem problem_of(std::span<const TeamTask> tasks,
                                     std::span<const TeamWorker> workers);

  const FlightConditions* conditions_;
  std::map<Executed, double> nearest_;  // to the begin of what is executed [s]
  std::set<std::uint32_t> tasks_;       // when it was last asked
  std::set<EntityId> workers_;
};

/// What a task is worth to a member of an auction, by the same rules (MarginalUtility):
/// its satisfaction over 1 + the hours to it from the last task of the bundle.
double worth_of(const TeamTask& task, const TeamResources& self,
                std::span<const TeamTask> bundle, const FlightConditions& conditions);

}  // namespace skein::reasoning
