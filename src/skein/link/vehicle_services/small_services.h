// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/link/mavlink/messages.h"
#include "skein/link/vehicle_services/outbox.h"
#include "skein/link/vehicle_services/vehicle_snapshot.h"

// Protocols that need no memory: clocks are answered, and what a simulated vehicle does
// not have (files, logs) is denied at once, so that nobody waits for it.

namespace skein::vehicle_services {

/// The clock that time stamps of telemetry are of. Answers to somebody's questions are
/// passed over.
void answer(const mavlink::Timesync& question, const Peer& from, const Clocks& now,
            Outbox& out);
void answer(const mavlink::Ping& question, const Peer& from, Outbox& out);

/// There are no files. Sessions are ended gladly, since none is open.
void answer(const mavlink::FileTransferProtocol& request, const Peer& from, Outbox& out);

/// There are no logs.
void answer(const mavlink::LogRequestList& request, const Peer& from, Outbox& out);
void answer(const mavlink::LogRequestData& request, const Peer& from, Outbox& out);

/// Says something, in as many parts as it needs.
/// @param number  distinguishes texts of several parts; not 0.
void send_text(const VehicleText& text, std::uint16_t number, Channel channel,
               Outbox& out);

}  // namespace skein::vehicle_services
