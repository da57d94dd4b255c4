// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/link/vehicle_services/command.h"
#include "skein/link/vehicle_services/vehicle_parts.h"

namespace skein::vehicle_services {

/// Commands that change nothing but what is sent: they are executed as often as they
/// come, and answered for everybody too.
bool is_query(mavlink::CommandId id);

/// Judges a query.
Answer judge_query(const Command& command, VehicleParts& parts, Channel channel);
/// Sends what was asked for, after the query was acknowledged as accepted.
void send_reply(const Command& command, const VehicleParts& parts, Channel channel,
                Outbox& out);

/// Executes a command that is no query.
Answer execute(const Command& command, VehicleParts& parts);

}  // namespace skein::vehicle_services
