// SPDX-License-Identifier: Apache-2.0
#include "app/net/experiment/network_run.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <utility>

#include "skein/layer/communication/propagation/obstructed.h"
#include "skein/layer/communication/propagation/path_loss.h"

namespace skein::experiment::network_run_test {
namespace {

NetworkCase row_of(std::uint32_t count, double spacing, Time duration) {
  NetworkCase network;
  for (std::uint32_t i = 0; i < count; ++i) {
    network.names.push_back(10 + i);
    network.nodes.push_back({{{Time(), Vec3(spacing * i, 0, 0)}}, std::nullopt});
  }
  network.duration = duration;
  return network;
}

communication::RadioProfile radio_of_tests() {
  communication::RadioProfile radio;
  radio.phy.frequency = 2e9;
  radio.phy.transmit_power_dbm = 1;
  radio.phy.transmit_gain_db = radio.phy.receive_gain_db = 1;
  radio.phy.decode_threshold_dbm = radio.phy.carrier_sense_threshold_dbm = -81;
  return radio;
}

TEST(NetworkRun, GivesEveryMessageOneFate) {
  NetworkCase network = row_of(6, 100, Time::from_seconds(2));
  RandomStream random(4, 0, Purpose::kTest);
  for (std::uint64_t i = 0; i < 4000; ++i) {
    TrafficItem item;
    item.message = i;
    item.time = Time::from_ns(static_cast<std::int64_t>(i) * 500'000);
    item.from = static_cast<std::uint32_t>(random.uniform(0, 6));
    item.to = static_cast<std::uint32_t>(random.uniform(0, 7));
    if (item.to == 6 || item.to == item.from) item.to = kAllNodesOfCase;
    item.bytes = static_cast<std::uint32_t>(random.uniform(0, 1500));
    network.traffic.push_back(item);
  }
  const communication::FreeSpace field(2e9);
  NetworkRun run(network, radio_of_tests(), field, 3);
  run.advance(network.duration);
  ASSERT_TRUE(run.done());
  // Nothing is lost without a cause: each message once, and none of the fates is empty.
  const auto& messages = run.result().messages;
  ASSERT_EQ(messages.size(), 4000u);
  std::map<MessageFate, int> fates;
  for (const NetworkMessage& message : messages) {
    ++fates[message.fate];
    EXPECT_EQ(message.delivered.has_value(),
              message.fate == MessageFate::kDelivered && message.to != kAllNodesOfCase);
    EXPECT_LE(message.transmissions, message.to == kAllNodesOfCase ? 1u : 7u);
  }
  for (const MessageFate fate : {MessageFate::kDelivered, MessageFate::kQueueFull,
                                 MessageFate::kRetryLimit, MessageFate::kPending})
    EXPECT_GT(fates[fate], 0) << static_cast<int>(fate);
  Time on_air;
  for (const NodeUse& use : run.result().nodes) on_air += use.airtime;
  EXPECT_GT(on_air.seconds(), 1);
}

TEST(NetworkRun, KeepsFlowsFull) {
  NetworkCase network = row_of(2, 100, Time::from_seconds(1));
  network.flows.push_back({0, 1, 1000, 5, Time::from_seconds(0.5)});
  const communication::FreeSpace field(2e9);
  NetworkRun run(network, radio_of_tests(), field, 3);
  run.advance(Time::from_seconds(0.5));
  EXPECT_TRUE(run.result().messages.empty());
  run.advance(network.duration);
  // One after the other: 5 ms each with back-off; 5 are left.
  const auto& messages = run.result().messages;
  EXPECT_NEAR(static_cast<double>(messages.size()), 0.5 / 0.005 + 5, 10);
  std::size_t pending = 0;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    EXPECT_EQ(messages[i].number, i);
    if (messages[i].fate == MessageFate::kPending) ++pending;
  }
  EXPECT_LE(pending, 5u);
  EXPECT_GE(pending, 4u);
}

// A packet that grows too old makes room for the next one while its line is being served.
TEST(NetworkRun, KeepsFlowsFullThatGrowTooOld) {
  for (const communication::AccessMethod access :
       {communication::AccessMethod::kDcf, communication::AccessMethod::kTdma,
        communication::AccessMethod::kDirect}) {
    NetworkCase network = row_of(3, 100, Time::from_seconds(5));
    network.flows = {{0, 1, 1000, 3, Time()}, {2, 1, 1000, 3, Time()}};
    communication::RadioProfile radio = radio_of_tests();
    radio.phy.rate = 100'000;
    radio.mac.access = access;
    radio.mac.slot = access == communication::AccessMethod::kTdma
                         ? Time::from_seconds(0.1)
                         : radio.mac.slot;
    radio.mac.latency = Time::from_seconds(0.5);
    radio.mac.queue_lifetime = Time::from_seconds(0.01);
    const communication::FreeSpace field(2e9);
    NetworkRun run(network, radio, field, 3);
    run.advance(network.duration);
    std::map<MessageFate, int> fates;
    for (const NetworkMessage& message : run.result().messages) ++fates[message.fate];
    EXPECT_GT(fates[MessageFate::kDelivered], 1);
    EXPECT_GT(fates[MessageFate::kExpired], 10);
  }
}

// A flow that is filled up for ever with what ends at once would never end.
TEST(NetworkRun, SaysThatASlotHoldsNoSuchMessage) {
  NetworkCase network = row_of(3, 100, Time::from_seconds(5));
  network.traffic = {{7, Time(), 0, kAllNodesOfCase, 1000},
                     {8, Time(), 0, 1, 1000},
                     {9, Time(), 0, 1, 100}};
  network.flows = {{1, 2, 1000, 3, Time()}};
  communication::RadioProfile radio = radio_of_tests();
  radio.phy.rate = 115'200;
  radio.mac.access = communication::AccessMethod::kTdma;
  radio.mac.slot = Time::from_ns(20'000'000);
  const communication::FreeSpace field(2e9);
  NetworkRun run(network, radio, field, 3);
  run.advance(network.duration);
  std::map<MessageFate, int> fates;
  for (const NetworkMessage& message : run.result().messages) {
    ++fates[message.fate];
    EXPECT_EQ(message.transmissions, message.bytes == 100 ? 1u : 0u);
  }
  EXPECT_EQ(fates, (std::map<MessageFate, int>{{MessageFate::kDelivered, 1},
                                               {MessageFate::kTooLong, 5}}));
}

TEST(NetworkRun, IsTheSameForEveryStep) {
  NetworkCase network = row_of(4, 90, Time::from_seconds(1));
  for (std::uint32_t node = 0; node < 4; ++node)
    network.flows.push_back({node, (node + 1) % 4, 700, 3, Time()});
  const communication::FreeSpace field(2e9);
  const auto starts = [&](int parts) {
    NetworkRun run(network, radio_of_tests(), field, 3);
    std::vector<std::int64_t> found;
    run.on_transmission = [&](const TransmissionRecord& transmission) {
      found.push_back(transmission.start.ns());
    };
    for (int part = 1; part <= parts; ++part)
      run.advance(Time::from_ns(network.duration.ns() / parts * part));
    return found;
  };
  EXPECT_EQ(starts(1), starts(100));
}

// The obstacle of [Selecky18] 6.4.2: three nodes, two of which have it between them.
TEST(NetworkRun, AnOpaqueObstacleSeparatesTwoOfThree) {
  NetworkCase network;
  const std::array<Vec3, 3> places = {Vec3(0, 0, -2), Vec3(100, 0, -2), Vec3(50, 80, -2)};
  for (std::uint32_t i = 0; i < 3; ++i) {
    network.names.push_back(i);
    network.nodes.push_back({{{Time(), places[i]}}, std::nullopt});
  }
  network.duration = Time::from_seconds(10);
  std::uint64_t number = 0;
  for (int k = 0; k < 20; ++k)
    for (std::uint32_t from = 0; from < 3; ++from)
      for (std::uint32_t to = 0; to < 3; ++to) {
        if (to == from) continue;
        TrafficItem item;
        item.message = number;
        item.time = Time::from_ns(static_cast<std::int64_t>(number) * 60'000'000);
        item.from = from;
        item.to = to;
        item.bytes = 500;
        network.traffic.push_back(item);
        ++number;
      }
  const std::vector<communication::Obstacle> house = {
      {geo::Ring{{40, -20}, {60, -20}, {60, 20}, {40, 20}}, 0, 30}};
  const auto delivered = [&](const std::vector<communication::Obstacle>& given) {
    const communication::Obstructed field(std::make_unique<communication::FreeSpace>(2e9),
                                          given);
    NetworkRun run(network, radio_of_tests(), field, 3);
    run.advance(network.duration);
    std::map<std::pair<communication::NodeIndex, communication::NodeIndex>, int> matrix;
    for (const NetworkMessage& message : run.result().messages)
      matrix[{message.from, message.to}] += message.fate == MessageFate::kDelivered;
    return matrix;
  };
  // Messages come one after the other: what is in range arrives for certain.
  for (const auto& [pair, count] : delivered({})) EXPECT_EQ(count, 20);
  for (const auto& [pair, count] : delivered(house)) {
    const bool behind = pair.first != 2 && pair.second != 2;
    EXPECT_EQ(count, behind ? 0 : 20) << pair.first << " to " << pair.second;
  }
}

}  // namespace
}  // namespace skein::experiment::network_run_test
