// SPDX-License-Identifier: Apache-2.0
// Messages that go from radio to radio, on the medium of a run.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "skein/layer/communication/medium_radio.h"
#include "skein/layer/communication/propagation/path_loss.h"
#include "skein/layer/communication/routing/flooding.h"
#include "skein/layer/communication/routing/learned_routes.h"

namespace skein::communication::medium_radio_routing_test {
namespace {

Message message_of(std::uint32_t from, std::uint32_t to, std::uint64_t number,
                   Time sent) {
  Message message;
  message.from = EntityId{from};
  message.to = EntityId{to};
  message.number = number;
  message.sent = sent;
  message.content = Heartbeat{};
  return message;
}

// Six in a chain, each in reach of its neighbours only, or as many as `nodes`.
class Chain {
 public:
  explicit Chain(std::unique_ptr<Routing> routing, MediumRadioOptions options = {},
                 std::uint32_t nodes = 6)
      : nodes_(nodes),
        gone_(nodes, false),
        radio_(
            [&options] {
              // 15 dBm and -90 dBm: 1.77 km at 2.4 GHz.
              options.profile.phy.decode_threshold_dbm = -90;
              options.profile.phy.carrier_sense_threshold_dbm = -95;
              return options;
            }(),
            std::make_unique<FreeSpace>(2.4e9),
            {nodes,
             [this](EntityId id) -> std::optional<Vec3> {
               if (gone_[id.value]) return std::nullopt;
               return Vec3(1200.0 * id.value, 0, -100);
             },
             [](EntityId id) { return "node " + std::to_string(id.value); }},
            7, std::move(routing)) {}

  void send(std::uint32_t from, std::uint32_t to) {
    radio_.send(message_of(from, to, number_++, now_));
  }
  void send_to_all(std::uint32_t from) {
    bool copy = false;
    for (std::uint32_t to = 0; to < nodes_; ++to) {
      if (to == from) continue;
      Message message = message_of(from, to, number_++, now_);
      message.copy = std::exchange(copy, true);
      radio_.send(message);
    }
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) {
      radio_.deliver(now_, news);
      now_ += Time::from_seconds(0.1);
    }
  }
  void remove(std::uint32_t node) { gone_[node] = true; }
  void turn_off(std::uint32_t node) { radio_.turn(EntityId{node}, false); }
  // Steps until a message has arrived; how many frames it took.
  std::uint32_t transmissions_of(std::uint32_t from, std::uint32_t to) {
    news.clear();
    send(from, to);
    steps(30);
    return news.ended.size() == 1 && news.ended[0].cause == LossCause::kNone
               ? news.ended[0].way.transmissions
               : 0;
  }
  std::size_t arrived() const {
    return static_cast<std::size_t>(
        std::count_if(news.ended.begin(), news.ended.end(),
                      [](const auto& each) { return each.cause == LossCause::kNone; }));
  }
  std::uint64_t sent() const { return number_; }

  RadioNews news;

 private:
  std::uint32_t nodes_;
  std::vector<bool> gone_;
  MediumRadio radio_;
  Time now_;
  std::uint64_t number_ = 0;
};

std::unique_ptr<Routing> flooding(std::uint32_t hops) {
  return std::make_unique<Flooding>(FloodingOptions{hops, 0.05}, 12, 7);
}

TEST(MediumRadioRouting, FloodingReachesWhoIsSeveralHopsAway) {
  Chain chain(flooding(4));
  chain.send(0, 5);
  chain.steps(30);
  ASSERT_EQ(chain.news.ended.size(), 1u);
  EXPECT_EQ(chain.news.ended[0].cause, LossCause::kNone);
  EXPECT_EQ(chain.news.ended[0].way.hops, 4u);
  EXPECT_EQ(chain.news.ended[0].way.transmissions, 5u) << "each sends it once";
}

TEST(MediumRadioRouting, FloodingEndsAfterItsHops) {
  Chain chain(flooding(3));
  chain.send(0, 5);
  chain.steps(30);
  ASSERT_EQ(chain.news.ended.size(), 1u);
  EXPECT_EQ(chain.news.ended[0].cause, LossCause::kOutOfRange);
}

TEST(MediumRadioRouting, WithoutRoutingNobodyPassesOn) {
  Chain chain(nullptr);
  chain.send(0, 2);
  chain.steps(30);
  ASSERT_EQ(chain.news.ended.size(), 1u);
  EXPECT_EQ(chain.news.ended[0].cause, LossCause::kRetryLimit);
}

TEST(MediumRadioRouting, FloodingCarriesWhatIsForAll) {
  Chain chain(flooding(5));
  chain.send_to_all(2);
  chain.steps(30);
  EXPECT_EQ(chain.arrived(), 5u);
  EXPECT_EQ(chain.news.ended.size(), 5u) << "each once";
}

TEST(MediumRadioRouting, WhoWasHeardLatelyIsToldDirectly) {
  MediumRadioOptions options;
  options.advertisement_period = 1;
  Chain chain(flooding(5), options);
  chain.steps(30);
  chain.send(0, 1);
  chain.steps(10);
  ASSERT_EQ(chain.news.ended.size(), 1u);
  EXPECT_EQ(chain.news.ended[0].way.transmissions, 1u) << "nobody else has passed it on";
}

TEST(MediumRadioRouting, FindsNeighboursAndLosesThem) {
  MediumRadioOptions options;
  options.advertisement_period = 1;
  Chain chain(nullptr, options, 3);
  chain.steps(40);
  const auto count = [&](EventKind kind) {
    return std::count_if(chain.news.events.begin(), chain.news.events.end(),
                         [&](const Event& event) { return event.kind == kind; });
  };
  EXPECT_EQ(count(EventKind::kNeighbourFound), 4) << "0-1 and 1-2, each of the other";
  EXPECT_EQ(count(EventKind::kNeighbourLost), 0);
  chain.remove(2);
  chain.steps(60);
  EXPECT_EQ(count(EventKind::kNeighbourLost), 2);
  EXPECT_EQ(chain.news.events.back().time.seconds() > 6, true)
      << "not before three periods of silence";
}

TEST(MediumRadioRouting, FloodingUnderLoadForgetsNothing) {
  Chain chain(flooding(3), {}, 12);
  RandomStream random(3, 0, Purpose::kTest);
  for (int step = 0; step < 200; ++step) {
    for (int k = 0; k < 6; ++k) {
      const auto from = static_cast<std::uint32_t>(random.uniform(0, 12));
      const auto to = static_cast<std::uint32_t>(random.uniform(0, 13));
      if (to == 12)
        chain.send_to_all(from);
      else if (to != from)
        chain.send(from, to);
    }
    chain.steps(1);
  }
  chain.steps(100);
  std::set<std::uint64_t> seen;
  for (const MessageOutcome& each : chain.news.ended)
    EXPECT_TRUE(seen.insert(each.message.number).second) << "twice";
  EXPECT_EQ(seen.size(), chain.sent());
  EXPECT_GT(chain.arrived(), chain.sent() / 4);
}

TEST(MediumRadioRouting, WhoIsOffPassesNothingOn) {
  Chain chain(flooding(5));
  chain.turn_off(2);
  EXPECT_EQ(chain.transmissions_of(0, 4), 0u);
}

TEST(MediumRadioRouting, AWayBackIsLearned) {
  MediumRadioOptions options;
  options.advertisement_period = 1;
  Chain chain(std::make_unique<LearnedRoutes>(LearnedRoutesOptions{{5, 0.05}}, 8, 7),
              options, 8);
  chain.steps(30);
  EXPECT_GE(chain.transmissions_of(2, 5), 5u) << "2, 1, 0 to 1, 3 and 4: it floods";
  EXPECT_EQ(chain.transmissions_of(5, 2), 3u) << "5, 4 and 3: the way back";
  EXPECT_EQ(chain.transmissions_of(2, 5), 3u) << "now this way too";
}

TEST(MediumRadioRouting, WhatALostNeighbourDoesNotAcknowledgeFloods) {
  MediumRadioOptions options;
  options.advertisement_period = 1;
  Chain chain(flooding(5), options, 3);
  chain.steps(30);
  chain.news.clear();
  // 1 still counts as heard by 0 for three seconds.
  chain.turn_off(1);
  chain.send(0, 1);
  chain.steps(10);
  ASSERT_EQ(chain.news.ended.size(), 1u);
  EXPECT_EQ(chain.news.ended[0].cause, LossCause::kRetryLimit);
  EXPECT_GT(chain.news.ended[0].way.transmissions, 7u) << "seven tries, then to all";
}

}  // namespace
}  // namespace skein::communication::medium_radio_routing_test
