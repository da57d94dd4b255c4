// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skein/data/airspace/zone.h"
#include "skein/data/command/command.h"
#include "skein/data/event/agent_record.h"
#include "skein/data/event/event.h"
#include "skein/data/radio/message.h"
#include "skein/data/radio/radio.h"
#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/payload.h"
#include "skein/data/vehicle/sensing.h"
#include "skein/data/vehicle/vehicle.h"

namespace skein {

/// What an agent perceives at one step. A ground station has no vehicle: `nav` is null.
struct AgentInput {
  Time now;
  const NavEstimate* nav = nullptr;
  AutopilotStatus autopilot;
  std::span<const SensorSample> samples;  ///< since the last step
  std::span<const Message> inbox;         ///< since the last step
  std::span<const Command> commands;      ///< to it, since the last step
  CommandFate command_fate = {};          ///< of the last AgentOutput::command
  RadioStatus radio = {};                 ///< of its modem
};

/// What an agent does at one step.
struct AgentOutput {
  std::vector<Message>
      outbox;  ///< `from`, `number` and `sent` are filled in by the sender
  std::optional<AutopilotCommand> command;
  std::optional<ReturnRoute>
      return_route;  ///< when returns shall lead elsewhere from now on
  std::optional<RegionOfInterest> region_of_interest;  ///< from now on
  std::optional<std::vector<Zone>> zones;  ///< no-fly, in force, when others are
  std::vector<Event> events;
  std::vector<AgentRecord> records;  ///< what else it wants to have recorded
};

}  // namespace skein
