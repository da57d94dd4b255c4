// SPDX-License-Identifier: Apache-2.0
#include "skein/link/relay/relay.h"

#include <variant>

#include "skein/link/relay/tcp_relay.h"
#include "skein/link/relay/udp_relay.h"

namespace skein::relay {

Result<std::unique_ptr<Relay>> Relay::open(const RelayOptions& options, RelayNews news) {
  if (std::holds_alternative<transport::UdpServer>(options.listen))
    return open_udp_relay(options, std::move(news));
  if (std::holds_alternative<transport::TcpServer>(options.listen))
    return open_tcp_relay(options, std::move(news));
  return Error{ErrorCode::kBadInput, transport::text_of(options.listen),
               "a relay cannot listen there.",
               "Use udpin:[HOST:]PORT or tcpin:[HOST:]PORT."};
}

}  // namespace skein::relay
