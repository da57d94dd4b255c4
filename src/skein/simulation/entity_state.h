// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "skein/data/command/command.h"
#include "skein/data/radio/message.h"
#include "skein/data/vehicle/agent_step.h"
#include "skein/data/vehicle/flight_path.h"
#include "skein/role/vehicle.h"
#include "skein/simulation/flight_ahead.h"
#include "skein/simulation/refusals.h"

namespace skein::simulation {

/// What an entity keeps between the phases of a step.
struct EntityState {
  bool active = false;
  bool begun = false;                    ///< it has been active
  std::optional<bool> commanded_active;  ///< an operator's word on it
  PayloadSamples payload;                ///< until the agent reads it
  std::size_t fresh = 0;                 ///< samples of this step begin here
  std::vector<Message> inbox;
  std::vector<Command> commands;
  AgentOutput output;
  std::uint64_t sent = 0;          ///< messages
  AutopilotStatus status;          ///< at the end of the last step
  bool lost = false;               ///< the same
  AutopilotStatus last_status;     ///< whose changes have been recorded
  bool was_on_ground = false;      ///< the same
  Refusals refusals;               ///< the same
  FlightAhead ahead;               ///< as its agent has commanded it
  std::optional<FlightPath> path;  ///< to be recorded
};

}  // namespace skein::simulation
