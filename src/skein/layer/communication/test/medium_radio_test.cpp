#include "skein/layer/communication/medium_radio.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "skein/layer/communication/propagation/path_loss.h"

namespace skein::communication {
namespace {

Message message_of(std::uint32_t from, std::uint32_t to, std::uint64_t number, Time sent,
                   std::size_t bytes = 0) {
  Message message;
  message.from = EntityId{from};
  message.to = EntityId{to};
  message.number = number;
  message.sent = sent;
  if (bytes > 0)
    message.content = PluginPayload{"test", std::vector<std::uint8_t>(bytes)};
  else
    message.content = Heartbeat{};
  return message;
}

// Four in a row, a kilometre apart; number 3 is out of range.
class Row {
 public:
  explicit Row(const MediumRadioOptions& options = {})
      : radio_(options, std::make_unique<FreeSpace>(2.4e9),
               {4,
                [](EntityId id) -> std::optional<Vec3> {
                  return Vec3(id.value == 3 ? 1e6 : 1000.0 * id.value, 0, -100);
                },
                [](EntityId id) { return "node " + std::to_string(id.value); }},
               7) {}

  // Sends to the others, as the simulation does: the first and its copies.
  void send_to_all(std::uint32_t from, std::size_t bytes = 0) {
    bool copy = false;
    for (std::uint32_t to = 0; to < 4; ++to) {
      if (to == from) continue;
      Message message = message_of(from, to, number_++, now_, bytes);
      message.copy = copy;
      copy = true;
      radio_.send(message);
    }
  }
  void send(std::uint32_t from, std::uint32_t to, std::size_t bytes = 0) {
    radio_.send(message_of(from, to, number_++, now_, bytes));
  }
  void step() {
    RadioNews news;
    radio_.deliver(now_, news);
    for (Event& event : news.events) events.push_back(std::move(event));
    for (const MessageOutcome& each : news.ended) {
      (each.cause == LossCause::kNone ? arrived : lost).push_back(each.message);
      outcomes.push_back(each);
    }
    now_ += Time::from_seconds(0.1);
  }

  std::vector<Message> arrived, lost;
  std::vector<MessageOutcome> outcomes;
  std::vector<Event> events;
  std::uint64_t sent() const { return number_; }
  MediumRadio& radio() { return radio_; }

 private:
  MediumRadio radio_;
  Time now_;
  std::uint64_t number_ = 0;
};

TEST(MediumRadio, DeliversAtANextStep) {
  Row row;
  row.send(0, 1);
  row.step();
  EXPECT_TRUE(row.arrived.empty());
  row.step();
  row.step();
  ASSERT_EQ(row.arrived.size(), 1u);
  EXPECT_EQ(row.arrived[0].to, EntityId{1});
  EXPECT_TRUE(std::holds_alternative<Heartbeat>(row.arrived[0].content));
}

TEST(MediumRadio, SendsToAllAtOnceAndLosesWhatIsOutOfRange) {
  Row row;
  row.send_to_all(1);
  row.send(0, 3);
  for (int i = 0; i < 20; ++i) row.step();
  ASSERT_EQ(row.arrived.size(), 2u);
  EXPECT_EQ(row.arrived[0].to, EntityId{0});
  EXPECT_EQ(row.arrived[1].to, EntityId{2});
  ASSERT_EQ(row.lost.size(), 2u);
  for (const Message& message : row.lost) EXPECT_EQ(message.to, EntityId{3});
}

TEST(MediumRadio, SendsLongMessagesInParts) {
  MediumRadioOptions options;
  options.profile.mac.queue_packets = 50;
  Row row(options);
  row.send(0, 1, 20'000);
  row.send_to_all(1, 5'000);
  for (int i = 0; i < 20; ++i) row.step();
  ASSERT_EQ(row.arrived.size(), 3u);
  for (const Message& message : row.arrived)
    EXPECT_EQ(std::get<PluginPayload>(message.content).coded.size(),
              message.from.value == 0 ? 20'000u : 5'000u);
}

TEST(MediumRadio, ALostPartLosesTheMessage) {
  MediumRadioOptions options;
  options.profile.mac.queue_packets = 5;
  Row row(options);
  row.send(0, 1, 20'000);
  for (int i = 0; i < 20; ++i) row.step();
  EXPECT_TRUE(row.arrived.empty());
  EXPECT_EQ(row.lost.size(), 1u);
}

TEST(MediumRadio, LosesUnderLoadAndForgetsNothing) {
  Row row;
  RandomStream random(3, 0, Purpose::kTest);
  for (int step = 0; step < 300; ++step) {
    for (int k = 0; k < 8; ++k) {
      const auto from = static_cast<std::uint32_t>(random.uniform(0, 4));
      const auto to = static_cast<std::uint32_t>(random.uniform(0, 5));
      const auto bytes = static_cast<std::size_t>(random.uniform(0, 6000));
      if (to == 4)
        row.send_to_all(from, bytes);
      else if (to != from)
        row.send(from, to, bytes);
    }
    row.step();
  }
  for (int i = 0; i < 100; ++i) row.step();
  std::set<std::uint64_t> seen;
  for (const auto* list : {&row.arrived, &row.lost})
    for (const Message& message : *list)
      EXPECT_TRUE(seen.insert(message.number).second) << "twice";
  EXPECT_EQ(seen.size(), row.sent());
  EXPECT_GT(row.arrived.size(), 200u);
  EXPECT_GT(row.lost.size(), 500u);
}

TEST(MediumRadio, ToNobodyIsLost) {
  Row row;
  row.send(0, 9);
  row.send(9, 0);
  for (int i = 0; i < 5; ++i) row.step();
  EXPECT_EQ(row.lost.size(), 2u);
}

TEST(MediumRadio, SaysWhyMessagesAreLostAndHowTheyWent) {
  MediumRadioOptions options;
  options.profile.mac.queue_packets = 2;
  Row row(options);
  row.send(0, 1);
  row.send(0, 3);          // out of range: given up
  row.send_to_all(1);      // to 3 out of range
  row.send(0, 9);          // nobody
  row.send(2, 1, 20'000);  // 14 parts, the queue holds two
  for (int i = 0; i < 20; ++i) row.step();
  std::map<std::uint32_t, LossCause> causes;  // by number
  for (const MessageOutcome& each : row.outcomes) {
    if (each.cause != LossCause::kNone)
      causes[static_cast<std::uint32_t>(each.message.number)] = each.cause;
    if (each.cause == LossCause::kNobody) continue;
    ASSERT_TRUE(each.way.on_air);
    EXPECT_GE(*each.way.on_air, each.message.sent);
    EXPECT_GE(each.way.transmissions, 1u);
  }
  EXPECT_EQ(causes, (std::map<std::uint32_t, LossCause>{{1, LossCause::kRetryLimit},
                                                        {4, LossCause::kOutOfRange},
                                                        {5, LossCause::kNobody},
                                                        {6, LossCause::kQueueFull}}));
}

TEST(MediumRadio, KeepsWhatRadiosAndLinksAreUsedFor) {
  MediumRadioOptions options;
  options.profile.mac.queue_packets = 100;
  Row row(options);
  for (int i = 0; i < 50; ++i) {
    row.send(0, 1, 1000);
    row.step();
  }
  const double airtime = 192e-6 + (1000 + 36) * 8 / 2e6;
  const RadioStatistics all = row.radio().take_statistics();
  ASSERT_EQ(all.radios.size(), 4u);
  // Ten messages a second, each some bytes longer than its payload: 1 % on top; what is
  // sent at the end is not over yet: one of fifty.
  EXPECT_NEAR(all.radios[0].sending_share, 10 * airtime, 10 * airtime * 0.04);
  EXPECT_NEAR(all.radios[1].busy_share, 10 * airtime, 10 * airtime * 0.04);
  EXPECT_GT(all.radios[1].sending_share, 0) << "it acknowledges";
  EXPECT_EQ(all.radios[3].busy_share, 0) << "it is out of range";
  EXPECT_NEAR(all.radios[1].received, 49, 1);
  ASSERT_EQ(all.links.size(), 1u) << "data goes one way";
  EXPECT_EQ(all.links[0].from, EntityId{0});
  EXPECT_EQ(all.links[0].to, EntityId{1});
  EXPECT_NEAR(all.links[0].arrived, 49, 1);
  // 15 dBm over 1 km of free space at 2.4 GHz: 100.05 dB less.
  EXPECT_NEAR(all.links[0].rssi_dbm.value(), 15 - 100.05, 0.1);
  EXPECT_GT(all.links[0].delay.value(), airtime);
  EXPECT_LT(all.links[0].delay.value(), 0.11) << "departures are spread over 0.1 s";
  EXPECT_NEAR(row.radio().status(EntityId{1}).load, 10 * airtime, 0.02);
  EXPECT_TRUE(row.radio().take_statistics().links.empty()) << "told once";
}

TEST(MediumRadio, UrgentMessagesGoFirstAndTakeTheLastPlace) {
  MediumRadioOptions options;
  options.profile.mac.queue_packets = 4;
  options.spread = 0;
  Row row(options);
  for (int i = 0; i < 6; ++i) row.send(0, 1, 1000);  // of plugins: as reports
  row.send(0, 1);                                    // a heartbeat
  for (int i = 0; i < 10; ++i) row.step();
  ASSERT_EQ(row.arrived.size(), 4u);
  // All came before the first could be sent.
  EXPECT_TRUE(std::holds_alternative<Heartbeat>(row.arrived[0].content));
  EXPECT_EQ(row.arrived[1].number, 0u);
  EXPECT_EQ(row.lost.size(), 3u);
}

// Six in a chain, each in reach of its neighbours only, or as many as `nodes`.
class Chain {
 public:
  explicit Chain(MediumRadioOptions options, std::uint32_t nodes = 6)
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
            7) {}

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

MediumRadioOptions flooding(std::uint32_t hops) {
  MediumRadioOptions options;
  options.routing = Routing::kFlooding;
  options.hops = hops;
  return options;
}

TEST(MediumRadio, FloodingReachesWhoIsSeveralHopsAway) {
  Chain chain(flooding(4));
  chain.send(0, 5);
  chain.steps(30);
  ASSERT_EQ(chain.news.ended.size(), 1u);
  EXPECT_EQ(chain.news.ended[0].cause, LossCause::kNone);
  EXPECT_EQ(chain.news.ended[0].way.hops, 4u);
  EXPECT_EQ(chain.news.ended[0].way.transmissions, 5u) << "each sends it once";
}

TEST(MediumRadio, FloodingEndsAfterItsHops) {
  Chain chain(flooding(3));
  chain.send(0, 5);
  chain.steps(30);
  ASSERT_EQ(chain.news.ended.size(), 1u);
  EXPECT_EQ(chain.news.ended[0].cause, LossCause::kOutOfRange);
}

TEST(MediumRadio, WithoutRoutingNobodyPassesOn) {
  Chain chain({});
  chain.send(0, 2);
  chain.steps(30);
  ASSERT_EQ(chain.news.ended.size(), 1u);
  EXPECT_EQ(chain.news.ended[0].cause, LossCause::kRetryLimit);
}

TEST(MediumRadio, FloodingCarriesWhatIsForAll) {
  Chain chain(flooding(5));
  chain.send_to_all(2);
  chain.steps(30);
  EXPECT_EQ(chain.arrived(), 5u);
  EXPECT_EQ(chain.news.ended.size(), 5u) << "each once";
}

TEST(MediumRadio, WhoWasHeardLatelyIsToldDirectly) {
  MediumRadioOptions options = flooding(5);
  options.advertisement_period = 1;
  Chain chain(options);
  chain.steps(30);
  chain.send(0, 1);
  chain.steps(10);
  ASSERT_EQ(chain.news.ended.size(), 1u);
  EXPECT_EQ(chain.news.ended[0].way.transmissions, 1u) << "nobody else has passed it on";
}

TEST(MediumRadio, FindsNeighboursAndLosesThem) {
  MediumRadioOptions options;
  options.advertisement_period = 1;
  Chain chain(options, 3);
  chain.steps(40);
  const auto count = [&](const char* kind) {
    return std::count_if(chain.news.events.begin(), chain.news.events.end(),
                         [&](const Event& event) { return event.kind == kind; });
  };
  EXPECT_EQ(count("neighbour-found"), 4) << "0-1 and 1-2, each of the other";
  EXPECT_EQ(count("neighbour-lost"), 0);
  chain.remove(2);
  chain.steps(60);
  EXPECT_EQ(count("neighbour-lost"), 2);
  EXPECT_EQ(chain.news.events.back().time.seconds() > 6, true)
      << "not before three periods of silence";
}

TEST(MediumRadio, FloodingUnderLoadForgetsNothing) {
  Chain chain(flooding(3), 12);
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

}  // namespace
}  // namespace skein::communication
