// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/foxglove/protocol.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

namespace skein::hmi::foxglove {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::byte kMessageData{1};
constexpr std::size_t kMaxInMessage = 10000;  // subscriptions
constexpr int kWarningStatus = 1;             // of statuses

SharedBytes text_of(const Json& message) {
  const std::string text = message.dump(-1, ' ', false, Json::error_handler_t::replace);
  auto bytes = std::make_shared<std::vector<std::byte>>(text.size());
  std::transform(text.begin(), text.end(), bytes->begin(),
                 [](char c) { return static_cast<std::byte>(c); });
  return bytes;
}

template <class Integer>
void put(std::vector<std::byte>& out, Integer value) {
  for (std::size_t k = 0; k < sizeof value; ++k)
    out.push_back(static_cast<std::byte>((value >> (8 * k)) & 0xFF));
}

std::optional<std::uint32_t> number(const Json& value) {
  if (!value.is_number_unsigned()) return std::nullopt;
  const auto wide = value.get<std::uint64_t>();
  return wide <= 0xFFFFFFFFu ? std::optional(static_cast<std::uint32_t>(wide))
                             : std::nullopt;
}

std::optional<std::uint32_t> number(const Json& object, const char* key) {
  if (!object.is_object()) return std::nullopt;
  const auto found = object.find(key);
  return found == object.end() ? std::nullopt : number(*found);
}

// The list under a key; null: there is none, or it is too long.
const Json* list(const Json& message, const char* key) {
  const auto found = message.find(key);
  const bool fits =
      found != message.end() && found->is_array() && found->size() <= kMaxInMessage;
  return fits ? &*found : nullptr;
}

Error malformed(const std::string& what) {
  return {ErrorCode::kBadInput, "", what, ""};
}

}  // namespace

bool is_protocol(std::string_view name) {
  return std::find(kProtocols.begin(), kProtocols.end(), name) != kProtocols.end();
}

Result<std::variant<Subscribe, Unsubscribe>> parse_client_message(std::string_view text) {
  const Json message = Json::parse(text, nullptr, false);
  if (!message.is_object() || !message.contains("op") || !message["op"].is_string())
    return malformed("a message is a JSON object with an \"op\".");
  const auto op = message["op"].get<std::string>();
  if (op == "subscribe") {
    const Json* all = list(message, "subscriptions");
    if (!all) return malformed("subscriptions are a list, and not too long.");
    Subscribe subscribe;
    for (const Json& each : *all) {
      const auto id = number(each, "id"), channel = number(each, "channelId");
      if (!id || !channel)
        return malformed("a subscription has an id and a channelId, whole numbers.");
      subscribe.all.push_back({*id, *channel});
    }
    return {std::move(subscribe)};
  }
  if (op == "unsubscribe") {
    const Json* all = list(message, "subscriptionIds");
    if (!all) return malformed("subscriptionIds are a list, and not too long.");
    Unsubscribe unsubscribe;
    for (const Json& each : *all) {
      const auto id = number(each);
      if (!id) return malformed("subscriptionIds are whole numbers.");
      unsubscribe.ids.push_back(*id);
    }
    return {std::move(unsubscribe)};
  }
  return malformed(
      fmt::format("\"{}\" is not done here: this server only shows.", op.substr(0, 40)));
}

SharedBytes server_info(const std::string& name, const std::string& session) {
  return text_of({{"op", "serverInfo"},
                  {"name", name},
                  {"capabilities", Json::array()},
                  {"supportedEncodings", Json::array()},
                  {"metadata", Json::object()},
                  {"sessionId", session}});
}

SharedBytes advertise(const std::vector<Channel>& channels) {
  Json all = Json::array();
  for (const Channel& channel : channels)
    all.push_back({{"id", channel.id},
                   {"topic", channel.topic},
                   {"encoding", "json"},
                   {"schemaName", channel.schema_name},
                   {"schema", channel.schema},
                   {"schemaEncoding", "jsonschema"}});
  return text_of({{"op", "advertise"}, {"channels", all}});
}

SharedBytes unadvertise(const std::vector<std::uint32_t>& channels) {
  return text_of({{"op", "unadvertise"}, {"channelIds", channels}});
}

SharedBytes warning(const std::string& text) {
  return text_of({{"op", "status"}, {"level", kWarningStatus}, {"message", text}});
}

SharedBytes message_data(std::uint32_t subscription, std::uint64_t time_ns,
                         std::string_view payload) {
  auto bytes = std::make_shared<std::vector<std::byte>>();
  bytes->reserve(1 + 4 + 8 + payload.size());
  bytes->push_back(kMessageData);
  put(*bytes, subscription);
  put(*bytes, time_ns);
  for (const char c : payload) bytes->push_back(static_cast<std::byte>(c));
  return bytes;
}

}  // namespace skein::hmi::foxglove
