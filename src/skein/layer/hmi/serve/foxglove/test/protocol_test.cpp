// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/foxglove/protocol.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace skein::hmi::foxglove::protocol_test {
namespace {

using Json = nlohmann::json;

Json parsed(const SharedBytes& bytes) {
  return Json::parse(
      std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()));
}

TEST(FoxgloveProtocol, KnowsItsTwoNames) {
  EXPECT_TRUE(is_protocol("foxglove.websocket.v1"));
  EXPECT_TRUE(is_protocol("foxglove.sdk.v1"));
  EXPECT_FALSE(is_protocol("skein.live.v1"));
}

TEST(FoxgloveProtocol, SubscriptionsComeAndGo) {
  const auto subscribe = parse_client_message(
      R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3},{"id":7,"channelId":4}]})");
  ASSERT_TRUE(subscribe);
  const auto& all = std::get<Subscribe>(subscribe.value()).all;
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[1].id, 7u);
  EXPECT_EQ(all[1].channel, 4u);
  const auto gone =
      parse_client_message(R"({"op":"unsubscribe","subscriptionIds":[7,0]})");
  ASSERT_TRUE(gone);
  EXPECT_EQ(std::get<Unsubscribe>(gone.value()).ids, (std::vector<std::uint32_t>{7, 0}));
}

TEST(FoxgloveProtocol, WhatIsMalformedOrNotDoneHereIsRefused) {
  for (const char* text :
       {"", "{", "[]", "7", R"({"op":3})", R"({"op":"subscribe"})",
        R"({"op":"subscribe","subscriptions":{}})",
        R"({"op":"subscribe","subscriptions":[3]})",
        R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":3}]})",
        R"({"op":"subscribe","subscriptions":[{"id":1.5,"channelId":3}]})",
        R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":3}]})",
        R"({"op":"unsubscribe","subscriptionIds":["a"]})",
        R"({"op":"advertise","channels":[]})", "\xff\xfe"})
    EXPECT_FALSE(parse_client_message(text)) << text;
}

TEST(FoxgloveProtocol, ChannelsAreAdvertisedWithTheirSchemas) {
  const Json message =
      parsed(advertise({{5, "/tf", "foxglove.FrameTransforms", R"({"type":"object"})"}}));
  EXPECT_EQ(message["op"], "advertise");
  const Json& channel = message["channels"].at(0);
  EXPECT_EQ(channel["id"], 5);
  EXPECT_EQ(channel["topic"], "/tf");
  EXPECT_EQ(channel["encoding"], "json");
  EXPECT_EQ(channel["schemaName"], "foxglove.FrameTransforms");
  EXPECT_EQ(channel["schema"], R"({"type":"object"})");
  EXPECT_EQ(parsed(server_info("run \xff", "s"))["op"], "serverInfo");  // bad UTF-8 too
}

TEST(FoxgloveProtocol, DataHasSubscriptionAndTimeBeforeIt) {
  const SharedBytes bytes = message_data(0x01020304, 0x1122334455667788, "{}");
  const std::vector<std::byte> expected{
      std::byte{1},    std::byte{4},    std::byte{3},    std::byte{2},    std::byte{1},
      std::byte{0x88}, std::byte{0x77}, std::byte{0x66}, std::byte{0x55}, std::byte{0x44},
      std::byte{0x33}, std::byte{0x22}, std::byte{0x11}, std::byte{'{'},  std::byte{'}'}};
  EXPECT_EQ(*bytes, expected);
}

}  // namespace
}  // namespace skein::hmi::foxglove::protocol_test
