// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "skein/base/result.h"
#include "skein/layer/hmi/serve/web_server.h"

// Messages of Foxglove's WebSocket protocol
// (github.com/foxglove/ws-protocol, docs/spec.md), as far as a server needs them that
// only shows something.

namespace skein::hmi::foxglove {

/// Names of the protocol for WebSockets, the older one first: what is used here is the
/// same in both.
inline constexpr std::array<std::string_view, 2> kProtocols{"foxglove.websocket.v1",
                                                            "foxglove.sdk.v1"};
bool is_protocol(std::string_view name);

/// Something that viewers may subscribe to.
struct Channel {
  std::uint32_t id = 0;
  std::string topic;
  std::string schema_name;
  std::string schema;  ///< JSON schema, as text
};

/// What a client wants to be sent from now on, and under which number.
struct Subscription {
  std::uint32_t id = 0;
  std::uint32_t channel = 0;
};
struct Subscribe {
  std::vector<Subscription> all;
};
struct Unsubscribe {
  std::vector<std::uint32_t> ids;
};

/// What a client says.
/// Fails: kBadInput for what is none of these, or malformed.
Result<std::variant<Subscribe, Unsubscribe>> parse_client_message(std::string_view text);

/// The first message of a server.
/// @param session  another one after the server was started anew.
SharedBytes server_info(const std::string& name, const std::string& session);
/// There are these channels too.
SharedBytes advertise(const std::vector<Channel>& channels);
/// These are gone.
SharedBytes unadvertise(const std::vector<std::uint32_t>& channels);
/// Says that something is wrong.
SharedBytes warning(const std::string& text);

/// A message of a subscription: binary.
/// @param time_ns  since 1970.
SharedBytes message_data(std::uint32_t subscription, std::uint64_t time_ns,
                         std::string_view payload);

}  // namespace skein::hmi::foxglove
