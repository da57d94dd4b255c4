// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/medium/medium.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace skein::communication::medium_test {
namespace {

constexpr double kWaveFactor = 299'792'458 / 2e9 / (4 * geo::kPi);

// Free space at 2 GHz, and walls between some pairs of nodes by their north coordinates.
class Field final : public Propagation {
 public:
  double received(double radiated, const Vec3& from, const Vec3& to) const override {
    const double distance = (from - to).norm();
    if (wall && (from.x() - *wall) * (to.x() - *wall) < 0) return 0;
    return distance > 0 ? radiated * std::pow(kWaveFactor / distance, 2) : radiated;
  }
  std::optional<double> wall;
};

// Keeps everything.
class Log final : public MediumListener {
 public:
  struct Sent {
    Time time;
    NodeIndex node;
    FrameKind kind;
  };
  void on_frame(const Frame& frame, Time now) override {
    frames.push_back({now, frame.from, frame.kind});
  }
  void on_delivered(const Frame& data, NodeIndex receiver, Time now,
                    const Reception&) override {
    delivered[data.tag].push_back({receiver, now});
  }
  void on_finished(const Packet& packet, PacketEnd end, Time) override {
    finished[packet.order.tag] = end;
  }

  std::vector<Sent> frames;
  std::map<std::uint64_t, std::vector<std::pair<NodeIndex, Time>>> delivered;
  std::map<std::uint64_t, PacketEnd> finished;
};

RadioProfile grid_radio() {
  RadioProfile radio;
  radio.phy.frequency = 2e9;
  radio.phy.transmit_power_dbm = 1;
  radio.phy.transmit_gain_db = radio.phy.receive_gain_db = 1;
  radio.phy.decode_threshold_dbm = radio.phy.carrier_sense_threshold_dbm = -77;
  return radio;
}

Links::Nodes standing(std::vector<Vec3> places) {
  Links::Nodes nodes;
  nodes.move = false;
  nodes.transmit_power_dbm.assign(places.size(), 1);
  nodes.place = [places](NodeIndex node, Time) { return places[node]; };
  return nodes;
}

double us(Time time) {
  return static_cast<double>(time.ns()) / 1e3;
}

TEST(Medium, SendsALoneMessageInTheTimeOfTheStandard) {
  const Field field;
  Log log;
  Medium medium(grid_radio(), field, standing({{0, 0, 0}, {100, 0, 0}}), 1, log);
  medium.advance(Time::from_seconds(1));
  ASSERT_TRUE(medium.send({0, 1, 1000, 7}));
  medium.advance(Time::from_seconds(2));
  ASSERT_EQ(log.delivered[7].size(), 1u);
  // DIFS 50, 192 + 1036 bytes at 2 Mbit/s, 100 m of way.
  EXPECT_NEAR(us(log.delivered[7][0].second) - 1e6, 4386.3, 0.1);
  EXPECT_EQ(log.finished.at(7), PacketEnd::kDone);
  EXPECT_EQ(medium.waiting(), 0u);
}

TEST(Medium, AnnouncesLongFramesByRtsAndCts) {
  const Field field;
  Log log;
  RadioProfile radio = grid_radio();
  radio.mac.rts_threshold_bytes = 500;
  Medium medium(radio, field, standing({{0, 0, 0}, {100, 0, 0}}), 1, log);
  medium.advance(Time::from_seconds(1));
  medium.send({0, 1, 1000, 7});
  medium.advance(Time::from_seconds(2));
  ASSERT_EQ(log.delivered[7].size(), 1u);
  EXPECT_NEAR(us(log.delivered[7][0].second) - 1e6, 4927.0, 0.1);
  ASSERT_EQ(log.frames.size(), 4u);
  EXPECT_EQ(log.frames[0].kind, FrameKind::kRts);
  EXPECT_EQ(log.frames[1].kind, FrameKind::kCts);
  EXPECT_EQ(log.frames[3].kind, FrameKind::kAck);
}

TEST(Medium, DoesNotDependOnHowOftenItIsAdvanced) {
  const Field field;
  const auto fly = [&](std::int64_t step_ns) {
    Log log;
    Medium medium(grid_radio(), field,
                  standing({{0, 0, 0}, {100, 0, 0}, {200, 0, 0}, {100, 100, 0}}), 5, log);
    for (std::int64_t ns = 0; ns < 400'000'000; ns += step_ns) {
      // Each sends at whole tenths of a second.
      if (ns % 20'000'000 == 0)
        for (NodeIndex node = 0; node < 4; ++node)
          medium.send({node, (node + 1) % 4, 800, node});
      medium.advance(Time::from_ns(ns + step_ns));
    }
    std::vector<std::int64_t> starts;
    for (const Log::Sent& sent : log.frames) starts.push_back(sent.time.ns());
    return starts;
  };
  const auto often = fly(1'000'000);
  EXPECT_GT(often.size(), 100u);
  EXPECT_EQ(often, fly(20'000'000));
}

TEST(Medium, GivesUpAfterSevenTransmissionsToNobody) {
  const Field field;
  Log log;
  Medium medium(grid_radio(), field, standing({{0, 0, 0}, {5000, 0, 0}}), 1, log);
  medium.send({0, 1, 200, 3});
  medium.advance(Time::from_seconds(1));
  EXPECT_EQ(log.frames.size(), 7u);
  EXPECT_EQ(log.finished.at(3), PacketEnd::kRetryLimit);
  EXPECT_TRUE(log.delivered.empty());
}

TEST(Medium, BroadcastsReachAllInRangeOnceAndNobodyBehindAWall) {
  Field field;
  field.wall = 150;
  Log log;
  Medium medium(grid_radio(), field,
                standing({{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {160, 0, 0}}), 1, log);
  medium.send({1, kAllNodes, 0, 3});
  medium.advance(Time::from_seconds(1));
  EXPECT_EQ(log.frames.size(), 1u);
  // Node 2 stands 141 m away, beyond 119 m; node 3 behind the wall.
  ASSERT_EQ(log.delivered[3].size(), 1u);
  EXPECT_EQ(log.delivered[3][0].first, 0u);
  EXPECT_EQ(medium.in_range(0), (std::vector<NodeIndex>{1, 2}));
}

TEST(Medium, RefusesWhatTheQueueCannotHoldAndDropsWhatIsTooOld) {
  const Field field;
  Log log;
  RadioProfile radio = grid_radio();
  radio.mac.queue_packets = 3;
  radio.mac.queue_lifetime = Time::from_ns(6'000'000);
  Medium medium(radio, field, standing({{0, 0, 0}, {100, 0, 0}}), 1, log);
  for (std::uint64_t tag = 0; tag < 3; ++tag) EXPECT_TRUE(medium.send({0, 1, 1000, tag}));
  EXPECT_FALSE(medium.send({0, 1, 1000, 3}));
  medium.advance(Time::from_seconds(1));
  // One takes 4.4 ms and its answer: the third waits for longer than 6 ms.
  EXPECT_EQ(log.finished.at(0), PacketEnd::kDone);
  EXPECT_EQ(log.finished.at(1), PacketEnd::kDone);
  EXPECT_EQ(log.finished.at(2), PacketEnd::kExpired);
}

// A to B and C to B, which do not hear each other.
std::pair<std::uint64_t, std::uint64_t> hidden(bool rts) {
  const Field field;
  struct Source final : MediumListener {
    void on_frame(const Frame&, Time) override {}
    void on_delivered(const Frame&, NodeIndex, Time, const Reception&) override {
      ++delivered;
    }
    void on_finished(const Packet& packet, PacketEnd, Time) override {
      ++done;
      medium->send(packet.order);
    }
    Medium* medium = nullptr;
    std::uint64_t delivered = 0, done = 0;
  } source;
  RadioProfile radio = grid_radio();
  if (rts) radio.mac.rts_threshold_bytes = 500;
  Medium medium(radio, field, standing({{0, 0, 0}, {100, 0, 0}, {200, 0, 0}}), 3, source);
  source.medium = &medium;
  for (const NodeIndex from : {0u, 2u})
    for (int i = 0; i < 5; ++i) medium.send({from, 1, 1000, 0});
  medium.advance(Time::from_seconds(60));
  return {source.delivered, source.done};
}

TEST(Medium, HiddenNodesLoseAndRtsHelpsThem) {
  // Of a packet-level simulator: 603 kbit/s and 82.1 %, with RTS 1425 kbit/s and 99.25 %.
  const auto [without, ended] = hidden(false);
  EXPECT_NEAR(static_cast<double>(without) * 8 / 60, 603, 0.03 * 603);
  EXPECT_NEAR(static_cast<double>(without) / static_cast<double>(ended), 0.821, 0.01);
  const auto [with, ended_with] = hidden(true);
  EXPECT_NEAR(static_cast<double>(with) * 8 / 60, 1425, 0.03 * 1425);
  EXPECT_NEAR(static_cast<double>(with) / static_cast<double>(ended_with), 0.9925, 0.01);
}

TEST(Medium, ManyNodesAtOnePlaceShareIt) {
  const Field field;
  Log log;
  RadioProfile radio = grid_radio();
  radio.phy.interference_floor_dbm = -101;
  Medium medium(radio, field, standing(std::vector<Vec3>(200, Vec3::Zero())), 1, log);
  for (NodeIndex node = 0; node < 200; ++node) medium.send({node, kAllNodes, 10, node});
  medium.advance(Time::from_seconds(2));
  EXPECT_EQ(log.finished.size(), 200u);
  EXPECT_EQ(medium.waiting(), 0u);
}

TEST(Medium, WithSlotsNobodyCollides) {
  const Field field;
  Log log;
  RadioProfile radio = grid_radio();
  radio.mac.access = AccessMethod::kTdma;
  radio.mac.slot = Time::from_ns(10'000'000);
  Medium medium(radio, field, standing({{0, 0, 0}, {100, 0, 0}, {50, 50, 0}}), 1, log);
  for (NodeIndex node = 0; node < 3; ++node)
    for (std::uint64_t k = 0; k < 3; ++k)
      medium.send({node, kAllNodes, 1000, 3 * node + k});
  medium.send({0, kAllNodes, 10'000, 99});
  medium.advance(Time::from_seconds(1));
  // A slot holds two frames of 4.3 ms, none of 40 ms.
  for (std::uint64_t tag = 0; tag < 9; ++tag) {
    EXPECT_EQ(log.delivered[tag].size(), 2u) << tag;
    EXPECT_EQ(log.finished.at(tag), PacketEnd::kDone);
  }
  EXPECT_EQ(log.finished.at(99), PacketEnd::kTooLong);
  for (const Log::Sent& sent : log.frames)
    EXPECT_EQ(sent.time.ns() / 10'000'000 % 3, sent.node);
}

TEST(Medium, ALineForEachIsLateAndLosesByChance) {
  const Field field;
  Log log;
  RadioProfile radio = grid_radio();
  radio.mac.access = AccessMethod::kDirect;
  radio.mac.latency = Time::from_seconds(0.5);
  radio.mac.loss = 0.3;
  radio.mac.queue_packets = 1000;
  Medium medium(radio, field, standing({{0, 0, 0}, {100, 0, 0}, {100, 50, 0}}), 1, log);
  for (std::uint64_t tag = 0; tag < 400; ++tag) medium.send({0, kAllNodes, 214, tag});
  medium.send({0, 1, 214, 400});
  medium.advance(Time::from_seconds(0.501));
  EXPECT_TRUE(log.delivered.empty());
  medium.advance(Time::from_seconds(5));
  int received = 0;
  for (const auto& [tag, receivers] : log.delivered)
    received += static_cast<int>(receivers.size());
  // One of 800 is 192 us and 250 bytes at 2 Mbit/s; 3 sigma of 800 draws are 39.
  EXPECT_NEAR(received, 560, 40);
  for (const auto& [receiver, time] : log.delivered[10])
    EXPECT_NEAR(us(time), 11 * 1192 + 500'000, 1);
  EXPECT_EQ(log.finished.size(), 401u);
}

TEST(Medium, NodesThatMoveComeIntoRange) {
  const Field field;
  Log log;
  Links::Nodes nodes = standing({{0, 0, 0}, {0, 0, 0}});
  nodes.move = true;
  nodes.place = [](NodeIndex node, Time now) {
    return Vec3(node == 0 ? 0 : 500 - 20 * now.seconds(), 0, 0);
  };
  Medium medium(grid_radio(), field, nodes, 1, log);
  for (std::uint64_t second = 0; second < 24; ++second) {
    medium.advance(Time::from_seconds(static_cast<double>(second)));
    medium.send({0, kAllNodes, 100, second});
  }
  medium.advance(Time::from_seconds(25));
  // 119 m are reached after 19 s.
  EXPECT_FALSE(log.delivered.contains(18));
  for (std::uint64_t second = 20; second < 24; ++second)
    EXPECT_TRUE(log.delivered.contains(second)) << second;
}

// Forward ten times as strong as backward.
class Forward final : public Antenna {
 public:
  double gain(const Vec3& direction_B) const override {
    ++asked;
    return direction_B.x() >= 0 ? 1 : 0.1;
  }
  mutable int asked = 0;
};

TEST(Links, TakeBothAntennasInTheirOwnBodies) {
  const Field field;
  const auto antenna = std::make_shared<Forward>();
  // Number 0 looks north, 1 looks south, 2 has no pattern. All on a line to the north.
  Links::Nodes nodes = standing({{0, 0, 0}, {100, 0, 0}, {200, 0, 0}});
  nodes.antennas.of = {antenna, antenna, nullptr};
  nodes.antennas.attitude = [](NodeIndex node, Time) {
    return node == 1 ? geo::from_euler({0, 0, geo::kPi}).toRotationMatrix()
                     : Mat3(Mat3::Identity());
  };
  Links with(grid_radio().phy, field, nodes);
  Links without(grid_radio().phy, field, standing({{0, 0, 0}, {100, 0, 0}, {200, 0, 0}}));
  const auto gain = [&](NodeIndex from, NodeIndex to) {
    const auto power = [&](Links& links) {
      for (const Link& link : links.of(from, Time()))
        if (link.to == to) return link.power;
      return 0.0;
    };
    return power(with) / power(without);
  };
  // Tolerance: roundings.
  EXPECT_NEAR(gain(0, 1), 1, 1e-12);  // face to face
  EXPECT_NEAR(gain(1, 0), 1, 1e-12);
  EXPECT_NEAR(gain(1, 2), 0.1, 1e-12);  // 2 is behind 1
  EXPECT_NEAR(gain(2, 1), 0.1, 1e-12);
  EXPECT_NEAR(gain(0, 2), 1, 1e-12);
}

TEST(Links, LookAtAntennasOnceBetweenChanges) {
  const Field field;
  const auto antenna = std::make_shared<Forward>();
  int attitudes = 0;
  Links::Nodes nodes = standing({{0, 0, 0}, {100, 0, 0}, {200, 0, 0}});
  nodes.antennas.of.assign(3, antenna);
  nodes.antennas.attitude = [&](NodeIndex, Time) {
    ++attitudes;
    return Mat3(Mat3::Identity());
  };
  Links links(grid_radio().phy, field, nodes);
  for (int i = 0; i < 10; ++i) links.of(0, Time::from_ns(i));
  EXPECT_EQ(antenna->asked, 4);
  EXPECT_EQ(attitudes, 3);
  links.renew();
  links.of(0, Time());
  links.of(1, Time());
  EXPECT_EQ(antenna->asked, 12);
  EXPECT_EQ(attitudes, 6);
}

}  // namespace
}  // namespace skein::communication::medium_test
