// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/link/mavlink/frame.h"
#include "skein/link/vehicle_services/command_service.h"
#include "skein/link/vehicle_services/vehicle_parts.h"

namespace skein::vehicle_services {

/// The parts of a VehicleServer that messages go to.
struct MessageTargets : VehicleParts {
  using VehicleParts::VehicleParts;
  CommandService commands;
};

/// Whether a frame is for this vehicle, or for all: most are for somebody else.
bool concerns(const mavlink::Frame& frame, const VehicleServerOptions& options);

/// Hands a frame that concerns the vehicle to the part whose business it is.
void dispatch(const mavlink::Frame& frame, Channel channel, MessageTargets& to,
              Outbox& out);

}  // namespace skein::vehicle_services
