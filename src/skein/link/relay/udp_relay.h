// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "skein/link/relay/relay.h"

namespace skein::relay {

/// A relay of datagrams. Fails: as Relay::open().
Result<std::unique_ptr<Relay>> open_udp_relay(const RelayOptions& options,
                                              RelayNews news);

}  // namespace skein::relay
