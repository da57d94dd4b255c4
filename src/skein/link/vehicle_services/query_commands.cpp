// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "skein/link/vehicle_services/message_numbers.h"
#include "skein/link/vehicle_services/vehicle_commands.h"

namespace skein::vehicle_services {
namespace {

using mavlink::CommandId;
using mavlink::CommandResult;

// The id of a message in a parameter; of none for what is no id.
std::uint32_t message_id(float parameter) {
  constexpr std::uint32_t kNone = 0xffffffff;
  if (!(parameter >= 0 && parameter < 16'777'216)) return kNone;
  return static_cast<std::uint32_t>(parameter);
}

}  // namespace

bool is_query(CommandId id) {
  switch (id) {
    case CommandId::kGetHome:
    case CommandId::kGetMessageInterval:
    case CommandId::kSetMessageInterval:
    case CommandId::kRequestMessage:
    case CommandId::kRequestProtocolVersion:
    case CommandId::kRequestCapabilities:
      return true;
    default:
      return false;
  }
}

Answer judge_query(const Command& command, VehicleParts& parts, Channel channel) {
  const ServedVehicle& vehicle = parts.vehicle;
  const std::uint32_t id = message_id(command.param(1));
  // Telemetry is made of what the simulation says.
  const Answer if_known =
      vehicle.known ? CommandResult::kAccepted : CommandResult::kTemporarilyRejected;
  switch (command.id) {
    case CommandId::kRequestMessage:
      if (!can_send(id, command.param(2), vehicle)) return CommandResult::kUnsupported;
      return telemetry_row_of(id, vehicle.options.make) ? if_known : Answer();
    case CommandId::kGetHome:
      return if_known;
    case CommandId::kSetMessageInterval:
      if (!parts.streams.set_interval(channel, id, static_cast<double>(command.param(2)),
                                      vehicle.now.simulated))
        return CommandResult::kUnsupported;
      return {};
    default:
      return {};
  }
}

void send_reply(const Command& command, const VehicleParts& parts, Channel channel,
                Outbox& out) {
  const ServedVehicle& vehicle = parts.vehicle;
  switch (command.id) {
    case CommandId::kRequestMessage:
      send_once(message_id(command.param(1)), command.param(2), vehicle, out, channel);
      break;
    case CommandId::kGetHome:
      out.send(channel, home_position(vehicle));
      break;
    case CommandId::kRequestProtocolVersion:
      out.send(channel, protocol_version(vehicle));
      break;
    case CommandId::kRequestCapabilities:
      out.send(channel, autopilot_version(vehicle));
      break;
    case CommandId::kGetMessageInterval: {
      mavlink::MessageInterval interval;
      const std::uint32_t id = message_id(command.param(1));
      interval.message_id = rounded<std::uint16_t>(id);
      interval.interval_us = parts.streams.interval_us(channel, id);
      out.send(channel, interval);
      break;
    }
    default:
      break;
  }
}

}  // namespace skein::vehicle_services
