// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/layer/reasoning/team/onboard/flight_conditions.h"
#include "skein/layer/reasoning/team/protocol/team_config.h"

namespace skein::reasoning {

/// How a team shares its tasks.
enum class TaskSharing : std::uint8_t {
  kCoalitions,  ///< CoalitionAllocation; in auctions by worth_of()
  kSequences,   ///< SequenceAllocation
  kNearest,     ///< allocate_nearest()
};

/// How tasks are shared, in what is believed of wind and zones.
/// @param conditions  outlive what is returned.
TeamConfig with_sharing(TeamConfig config, TaskSharing sharing,
                        const FlightConditions& conditions);

}  // namespace skein::reasoning
