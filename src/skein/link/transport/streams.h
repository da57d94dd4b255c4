// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "skein/link/transport/hub.h"

namespace skein::transport {

/// Fails: kBadInput where a host has no address or a place is taken.
Result<std::unique_ptr<Endpoint>> open_tcp(Hub& hub, const TcpServer& address);
Result<std::unique_ptr<Endpoint>> open_tcp(Hub& hub, const TcpClient& address);

/// A line that is not there yet is waited for.
std::unique_ptr<Endpoint> open_serial(Hub& hub, const SerialLine& address);

}  // namespace skein::transport
