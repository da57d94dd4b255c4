// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/onboard/task_sharing.h"

#include <span>

#include "skein/layer/reasoning/team/onboard/coalition_allocation.h"
#include "skein/layer/reasoning/team/onboard/sequence_allocation.h"

namespace skein::reasoning {

TeamConfig with_sharing(TeamConfig config, TaskSharing sharing,
                        const FlightConditions& conditions) {
  if (sharing == TaskSharing::kNearest) return config;
  if (sharing == TaskSharing::kSequences)
    config.allocate = SequenceAllocation(conditions);
  else
    config.allocate = CoalitionAllocation(conditions);
  config.utility = [&conditions](const TeamTask& task, const TeamResources& self,
                                 std::span<const TeamTask> bundle) {
    return worth_of(task, self, bundle, conditions);
  };
  return config;
}

}  // namespace skein::reasoning
