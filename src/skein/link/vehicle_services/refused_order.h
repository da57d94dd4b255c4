// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/link/mavlink/frame.h"
#include "skein/link/vehicle_services/outbox.h"

namespace skein::vehicle_services {

/// Answers an order that was not even looked at, because its sender is not known: a
/// command is denied, a mission or fence too; other messages have no answer.
void refuse_order(const mavlink::Frame& frame, Channel channel, Outbox& out);

}  // namespace skein::vehicle_services
