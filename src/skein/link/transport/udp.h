// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "skein/link/transport/hub.h"

namespace skein::transport {

/// Fails: kBadInput where a host has no address or a place is taken.
Result<std::unique_ptr<Endpoint>> open_udp(Hub& hub, const UdpServer& address);
Result<std::unique_ptr<Endpoint>> open_udp(Hub& hub, const UdpClient& address);
Result<std::unique_ptr<Endpoint>> open_udp(Hub& hub, const UdpBroadcast& address);
/// What it sends comes back to the programs of this machine too, to itself as well; it
/// gets no further than the network.
Result<std::unique_ptr<Endpoint>> open_udp(Hub& hub, const UdpMulticast& address);

}  // namespace skein::transport
