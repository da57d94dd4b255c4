// SPDX-License-Identifier: Apache-2.0
// Whatever the network: nothing is lost without a cause, and nothing piles up.
#include <gtest/gtest.h>
#include <malloc.h>
#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "app/net/experiment/network_run.h"
#include "skein/base/random.h"
#include "skein/layer/communication/medium/medium.h"
#include "skein/layer/communication/propagation/path_loss.h"

namespace skein::experiment::conservation_test {
namespace {

constexpr std::array kMethods = {communication::AccessMethod::kDcf,
                                 communication::AccessMethod::kTdma,
                                 communication::AccessMethod::kDirect};

communication::RadioProfile radio_of(communication::AccessMethod access) {
  communication::RadioProfile radio;
  radio.phy.frequency = 2e9;
  radio.phy.transmit_power_dbm = 1;
  radio.phy.transmit_gain_db = radio.phy.receive_gain_db = 1;
  radio.phy.decode_threshold_dbm = radio.phy.carrier_sense_threshold_dbm = -81;
  radio.mac.access = access;
  if (access == communication::AccessMethod::kTdma)
    radio.mac.slot = Time::from_ns(10'000'000);
  return radio;
}

communication::RadioProfile any_radio() {
  communication::RadioProfile radio = radio_of(*rc::gen::elementOf(kMethods));
  if (*rc::gen::arbitrary<bool>()) radio.phy.carrier_sense_threshold_dbm = -91;
  if (*rc::gen::arbitrary<bool>()) radio.mac.rts_threshold_bytes = 500;
  if (*rc::gen::arbitrary<bool>())
    radio.mac.queue_lifetime = Time::from_ns(*rc::gen::inRange(1, 200) * 1'000'000LL);
  radio.mac.queue_packets = *rc::gen::inRange<std::uint32_t>(1, 12);
  radio.mac.latency = Time::from_ns(*rc::gen::inRange(0, 500) * 1'000'000LL);
  radio.mac.loss = *rc::gen::element(0.0, 0.2, 1.0);
  return radio;
}

// Nodes that stand or fly within half a kilometre, and send for two seconds.
NetworkCase any_network() {
  NetworkCase network;
  RandomStream random(*rc::gen::arbitrary<std::uint32_t>(), 0, Purpose::kTest);
  const auto nodes = *rc::gen::inRange<std::uint32_t>(2, 10);
  const bool move = *rc::gen::arbitrary<bool>();
  const auto place = [&] {
    return Vec3(random.uniform(0, 500), random.uniform(0, 500), -random.uniform(0, 100));
  };
  for (std::uint32_t node = 0; node < nodes; ++node) {
    NodeTrack track;
    track.points.push_back({Time(), place()});
    if (move) track.points.push_back({Time::from_seconds(2), place()});
    network.names.push_back(node);
    network.nodes.push_back(track);
  }
  const auto count = *rc::gen::inRange<std::uint64_t>(0, 800);
  for (std::uint64_t i = 0; i < count; ++i) {
    TrafficItem item;
    item.message = i;
    item.time =
        Time::from_seconds(2.0 * static_cast<double>(i) / static_cast<double>(count));
    item.from = static_cast<std::uint32_t>(random.uniform(0, nodes));
    item.to = static_cast<std::uint32_t>(random.uniform(0, nodes));
    if (item.to == item.from) item.to = kAllNodesOfCase;
    item.bytes = static_cast<std::uint32_t>(random.uniform(0, 1500));
    network.traffic.push_back(item);
  }
  // Long enough for all to end after the last one was sent: 11 in a queue, of which each
  // is repeated six times with up to 1023 slots before.
  network.duration = Time::from_seconds(30);
  return network;
}

TEST(Conservation, EveryMessageIsDeliveredLostByACauseOrPending) {
  EXPECT_TRUE(rc::check([] {
    const NetworkCase network = any_network();
    const communication::RadioProfile radio = any_radio();
    const communication::FreeSpace field(2e9);
    NetworkRun run(network, radio, field, *rc::gen::arbitrary<std::uint32_t>());
    const std::size_t room = network.nodes.size() * radio.mac.queue_packets;
    for (const double time : {0.3, 1.1, 2.0, 30.0}) {
      run.advance(Time::from_seconds(time));
      std::map<MessageFate, std::size_t> fates;
      for (const NetworkMessage& message : run.result().messages) {
        ++fates[message.fate];
        const bool unicast = message.to != kAllNodesOfCase;
        RC_ASSERT(message.delivered.has_value() ==
                  (unicast && message.fate == MessageFate::kDelivered));
        if (message.delivered) RC_ASSERT(*message.delivered > message.sent);
        if (message.fate == MessageFate::kQueueFull ||
            message.fate == MessageFate::kExpired)
          RC_ASSERT(message.in_range.empty());
        if (message.fate == MessageFate::kQueueFull)
          RC_ASSERT(message.transmissions == 0u);
        if (message.fate == MessageFate::kDelivered || message.fate == MessageFate::kLost)
          RC_ASSERT(message.transmissions > 0u);
        // Only what nobody acknowledges is sent and lost.
        if (message.fate == MessageFate::kLost)
          RC_ASSERT(unicast && radio.mac.access != communication::AccessMethod::kDcf);
        for (const BroadcastReception& each : message.in_range) {
          RC_ASSERT(each.node != message.from);
          if (each.delivered) RC_ASSERT(*each.delivered > message.sent);
        }
      }
      // Those on the way by a line of their own left the queue and are not there yet.
      if (radio.mac.access != communication::AccessMethod::kDirect)
        RC_ASSERT(fates[MessageFate::kPending] <= room);
    }
    RC_ASSERT(run.result().messages.size() == network.traffic.size());
    for (const NetworkMessage& message : run.result().messages)
      RC_ASSERT(message.fate != MessageFate::kPending);
  }));
}

// Counts what it is told, by the order's tag.
struct Ledger final : communication::MediumListener {
  void on_frame(const communication::Frame& frame, Time) override {
    if (frame.kind == communication::FrameKind::kData) on_air.insert(frame.tag);
  }
  void on_delivered(const communication::Frame& data, communication::NodeIndex receiver,
                    Time, const communication::Reception&) override {
    RC_ASSERT(on_air.contains(data.tag));
    RC_ASSERT(receiver != data.from);
    if (data.to != communication::kAllNodes) RC_ASSERT(receiver == data.to);
    RC_ASSERT(delivered.insert({data.tag, receiver}).second);
  }
  void on_finished(const communication::Packet& packet, communication::PacketEnd,
                   Time) override {
    RC_ASSERT(finished.insert(packet.order.tag).second);
  }

  std::set<std::uint64_t> on_air, finished;
  std::set<std::pair<std::uint64_t, communication::NodeIndex>> delivered;
};

TEST(Conservation, ThePacketsOfAMediumWaitOrAreFinishedOnce) {
  EXPECT_TRUE(rc::check([] {
    const NetworkCase network = any_network();
    const communication::FreeSpace field(2e9);
    Ledger ledger;
    communication::Links::Nodes nodes;
    nodes.transmit_power_dbm.assign(network.nodes.size(), 1);
    nodes.place = [&](communication::NodeIndex node, Time now) {
      return network.nodes[node].place(now);
    };
    communication::Medium medium(any_radio(), field, nodes,
                                 *rc::gen::arbitrary<std::uint32_t>(), ledger);
    std::size_t accepted = 0;
    for (const TrafficItem& item : network.traffic) {
      medium.advance(item.time);
      accepted += medium.send({item.from, item.to, item.bytes, item.message});
      RC_ASSERT(accepted == ledger.finished.size() + medium.waiting());
    }
    medium.advance(network.duration);
    RC_ASSERT(medium.waiting() == 0u);
    RC_ASSERT(accepted == ledger.finished.size());
  }));
}

struct Counter final : communication::MediumListener {
  void on_frame(const communication::Frame&, Time) override {}
  void on_delivered(const communication::Frame&, communication::NodeIndex, Time,
                    const communication::Reception&) override {
    ++delivered;
  }
  void on_finished(const communication::Packet&, communication::PacketEnd,
                   Time) override {
    ++finished;
  }
  std::uint64_t delivered = 0, finished = 0;
};

std::size_t heap_in_use() {
  const struct mallinfo2 heap = mallinfo2();
  return heap.uordblks + heap.hblkhd;
}

TEST(Conservation, MemoryOfADayIsThatOfAnHour) {
  constexpr std::uint32_t kNodes = 6;
  constexpr std::int64_t kStep = 500'000'000, kHour = 3'600'000'000'000;
  for (const communication::AccessMethod access : kMethods) {
    const communication::FreeSpace field(2e9);
    Counter counter;
    communication::Links::Nodes nodes;
    nodes.transmit_power_dbm.assign(kNodes, 1);
    // On circles of a hundred metres, each with a period of its own.
    nodes.place = [](communication::NodeIndex node, Time now) {
      const double angle = now.seconds() / (5 + node);
      return Vec3(100 * std::cos(angle), 100 * std::sin(angle), 0);
    };
    communication::Medium medium(radio_of(access), field, nodes, 1, counter);
    RandomStream random(1, 0, Purpose::kTest);
    std::uint64_t accepted = 0;
    std::size_t after_an_hour = 0;
    for (std::int64_t ns = 0; ns < 24 * kHour; ns += kStep) {
      medium.advance(Time::from_ns(ns));
      if (ns == kHour) after_an_hour = heap_in_use();
      const auto from = static_cast<communication::NodeIndex>(random.uniform(0, kNodes));
      const communication::NodeIndex to =
          random.uniform() < 0.5 ? communication::kAllNodes : (from + 1) % kNodes;
      // Several at once, so that frames meet.
      for (communication::NodeIndex k = 0; k < 3; ++k)
        accepted +=
            medium.send({(from + k) % kNodes,
                         to == communication::kAllNodes ? to : (from + k + 1) % kNodes,
                         static_cast<std::uint32_t>(random.uniform(0, 1000)), 0});
    }
    // Half a million packets: a byte of each would be seen. A rare moment at which more
    // frames meet than ever before may double a small store.
    EXPECT_LE(heap_in_use(), after_an_hour + 16'384) << static_cast<int>(access);
    EXPECT_EQ(accepted, counter.finished + medium.waiting());
    EXPECT_GT(counter.delivered, 100'000u);
  }
}

}  // namespace
}  // namespace skein::experiment::conservation_test
