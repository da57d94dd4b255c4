// SPDX-License-Identifier: Apache-2.0
// Entities that are reached at the node of a ground station, on the medium of a run.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "skein/base/random.h"
#include "skein/layer/communication/medium_radio.h"
#include "skein/layer/communication/propagation/path_loss.h"
#include "skein/layer/communication/routing/flooding.h"

namespace skein::communication::medium_radio_gateway_test {
namespace {

// Who is who. The real ones are a thousand kilometres off, each on another side.
constexpr std::uint32_t kStation = 0, kNear = 1, kReal = 2, kFar = 3, kOtherReal = 4;
constexpr std::uint32_t kAllOfThem = 5;

std::optional<Vec3> place_of(EntityId id) {
  switch (id.value) {
    case kNear:
      return Vec3(1000, 0, -100);
    case kFar:
      return Vec3(9000, 0, -100);
    case kReal:
      return Vec3(1e6, 0, -100);
    case kOtherReal:
      return Vec3(-1e6, 0, -100);
    default:
      return Vec3(0, 0, -100);
  }
}

class Gateway {
 public:
  explicit Gateway(std::unique_ptr<Routing> routing = nullptr,
                   MediumRadioOptions options = {})
      : radio_(
            [&options] {
              // 15 dBm and -90 dBm: 1.77 km at 2.4 GHz.
              options.profile.phy.decode_threshold_dbm = -90;
              options.profile.phy.carrier_sense_threshold_dbm = -95;
              return options;
            }(),
            std::make_unique<FreeSpace>(2.4e9),
            {kAllOfThem,
             place_of,
             [](EntityId id) { return "node " + std::to_string(id.value); },
             {},
             {EntityId{kStation}, EntityId{kNear}, EntityId{kStation}, EntityId{kFar},
              EntityId{kStation}}},
            7, std::move(routing)) {}

  void send(std::uint32_t from, std::uint32_t to, std::size_t bytes = 0) {
    radio_.send(message(from, to, bytes));
  }
  void send_to_all(std::uint32_t from, std::size_t bytes = 0) {
    bool copy = false;
    for (std::uint32_t to = 0; to < kAllOfThem; ++to) {
      if (to == from) continue;
      Message said = message(from, to, bytes);
      said.copy = std::exchange(copy, true);
      radio_.send(said);
    }
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) {
      radio_.deliver(now_, news);
      now_ += Time::from_seconds(0.1);
    }
  }
  // Receivers of what has arrived.
  std::set<std::uint32_t> reached() const {
    std::set<std::uint32_t> all;
    for (const MessageOutcome& each : news.ended)
      if (each.cause == LossCause::kNone) all.insert(each.message.to.value);
    return all;
  }
  MediumRadio& radio() { return radio_; }
  std::uint64_t sent() const { return number_; }

  RadioNews news;

 private:
  Message message(std::uint32_t from, std::uint32_t to, std::size_t bytes) {
    Message message;
    message.from = EntityId{from};
    message.to = EntityId{to};
    message.number = number_++;
    message.sent = now_;
    if (bytes > 0)
      message.content = PluginPayload{"test", std::vector<std::uint8_t>(bytes)};
    else
      message.content = Heartbeat{};
    return message;
  }

  MediumRadio radio_;
  Time now_;
  std::uint64_t number_ = 0;
};

using Set = std::set<std::uint32_t>;

TEST(MediumRadioGateway, RealOnesAreReachedWhereTheStationIs) {
  Gateway near;
  near.send(kNear, kReal);
  near.steps(5);
  EXPECT_EQ(near.reached(), Set{kReal});
  Gateway far;
  far.send(kFar, kReal);
  far.steps(100);
  EXPECT_TRUE(far.reached().empty());
  ASSERT_EQ(far.news.ended.size(), 1u);
  EXPECT_EQ(far.news.ended[0].message.to, EntityId{kReal});
}

TEST(MediumRadioGateway, WhatRealOnesSayComesFromTheStation) {
  Gateway air;
  air.send(kReal, kNear);
  air.send(kReal, kFar);
  air.steps(100);
  EXPECT_EQ(air.reached(), Set{kNear});
  const RadioStatistics used = air.radio().take_statistics();
  EXPECT_GT(used.radios.at(kStation).frames, 0u);
  EXPECT_EQ(used.radios.at(kReal).frames, 0u);
}

TEST(MediumRadioGateway, ABroadcastReachesAllWhoAreAtTheStation) {
  Gateway from_near;
  from_near.send_to_all(kNear);
  from_near.steps(100);
  EXPECT_EQ(from_near.reached(), (Set{kStation, kReal, kOtherReal}));
  EXPECT_EQ(from_near.news.ended.size(), 4u);
  Gateway from_real;
  from_real.send_to_all(kReal);
  from_real.steps(100);
  EXPECT_EQ(from_real.reached(), (Set{kStation, kNear, kOtherReal}));
  EXPECT_EQ(from_real.news.ended.size(), 4u);
}

TEST(MediumRadioGateway, AtOneNodeMessagesArriveAtOnceAndTakeTheAir) {
  for (const auto& [from, to] : {std::pair(kReal, kStation), std::pair(kStation, kReal),
                                 std::pair(kReal, kOtherReal)}) {
    Gateway air;
    air.send(from, to, 5'000);
    air.steps(1);
    ASSERT_EQ(air.news.ended.size(), 1u);
    EXPECT_EQ(air.news.ended[0].message.to, EntityId{to});
    EXPECT_EQ(std::get<PluginPayload>(air.news.ended[0].message.content).coded.size(),
              5'000u);
    air.steps(20);
    EXPECT_EQ(air.news.ended.size(), 1u);
    EXPECT_GT(air.radio().take_statistics().radios.at(kStation).sending_share, 0.005);
  }
}

TEST(MediumRadioGateway, WhatIsAtTheStationIsNotPassedOn) {
  Gateway air(std::make_unique<Flooding>(FloodingOptions{}, kAllOfThem, 7));
  air.send(kReal, kStation);
  air.steps(20);
  EXPECT_EQ(air.radio().take_statistics().radios.at(kNear).frames, 0u);
}

TEST(MediumRadioGateway, NobodyFindsARealOneAsANeighbour) {
  MediumRadioOptions options;
  options.advertisement_period = 1;
  Gateway air(nullptr, options);
  air.steps(50);
  Set found;
  for (const Event& event : air.news.events) {
    EXPECT_EQ(event.kind, EventKind::kNeighbourFound);
    found.insert(event.entity.value);
    EXPECT_TRUE(event.text == "node 0" || event.text == "node 1") << event.text;
  }
  EXPECT_EQ(found, (Set{kStation, kNear}));
}

TEST(MediumRadioGateway, WhoIsOffIsNotReached) {
  Gateway air;
  air.radio().turn(EntityId{kReal}, false);
  air.send_to_all(kNear);
  air.steps(100);
  EXPECT_EQ(air.reached(), (Set{kStation, kOtherReal}));
}

TEST(MediumRadioGateway, EachMessageEndsOnce) {
  for (const bool floods : {false, true}) {
    Gateway air(floods ? std::make_unique<Flooding>(FloodingOptions{}, kAllOfThem, 7)
                       : nullptr);
    RandomStream random(3, 0, Purpose::kTest);
    for (int k = 0; k < 300; ++k) {
      for (int n = 0; n < 10; ++n) {
        const auto from = static_cast<std::uint32_t>(random.uniform(0, kAllOfThem));
        const auto to = static_cast<std::uint32_t>(random.uniform(0, kAllOfThem + 1));
        const auto bytes = static_cast<std::size_t>(random.uniform(0, 4000));
        if (to == kAllOfThem)
          air.send_to_all(from, bytes);
        else if (to != from)
          air.send(from, to, bytes);
      }
      air.steps(1);
    }
    air.radio().end(air.news);
    std::set<std::uint64_t> numbers;
    for (const MessageOutcome& each : air.news.ended)
      EXPECT_TRUE(numbers.insert(each.message.number).second) << each.message.number;
    EXPECT_EQ(numbers.size(), air.sent());
  }
}

}  // namespace
}  // namespace skein::communication::medium_radio_gateway_test
