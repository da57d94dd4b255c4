// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/medium_radio.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "skein/layer/communication/propagation/path_loss.h"

namespace skein::communication::medium_radio_test {
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
  // Messages of anybody to anybody or all, whatever happens.
  void talk(RandomStream& random, int messages) {
    for (int k = 0; k < messages; ++k) {
      const auto from = static_cast<std::uint32_t>(random.uniform(0, 4));
      const auto to = static_cast<std::uint32_t>(random.uniform(0, 5));
      const auto bytes = static_cast<std::size_t>(random.uniform(0, 6000));
      if (to == 4)
        send_to_all(from, bytes);
      else if (to != from)
        send(from, to, bytes);
    }
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

TEST(MediumRadio, LosesUnderLoad) {
  Row row;
  RandomStream random(3, 0, Purpose::kTest);
  for (int step = 0; step < 300; ++step) {
    row.talk(random, 8);
    row.step();
  }
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

TEST(MediumRadio, WhoIsOffSendsAndHearsNothing) {
  MediumRadioOptions options;
  options.advertisement_period = 1;
  Row row(options);
  row.radio().turn(EntityId{1}, false);
  for (int i = 0; i < 30; ++i) {
    if (i % 5 == 0) row.send(0, 1), row.send_to_all(2);
    row.step();
  }
  EXPECT_TRUE(row.arrived.empty()) << "0 and 2 hear 1 only";
  EXPECT_EQ(row.lost.size(), row.sent());
  for (const Event& event : row.events) {
    EXPECT_NE(event.entity, EntityId{1});
    EXPECT_NE(event.text, "node 1");
  }
  row.radio().turn(EntityId{1}, true);
  row.send(0, 1);
  for (int i = 0; i < 30; ++i) row.step();
  EXPECT_EQ(row.arrived.size(), 1u);
  EXPECT_TRUE(std::any_of(row.events.begin(), row.events.end(),
                          [](const Event& event) { return event.text == "node 1"; }));
}

TEST(MediumRadio, WhatIsOnItsWayInTheEndIsPending) {
  MediumRadioOptions options;
  options.profile.phy.rate = 1000;
  options.profile.mac.queue_packets = 100;
  Row row(options);
  for (int i = 0; i < 20; ++i) row.send(0, 1, 100);
  row.send_to_all(2);
  for (int i = 0; i < 20; ++i) row.step();
  row.send(1, 2);  // not even handed to the radio
  RadioNews news;
  row.radio().end(news);
  EXPECT_GT(news.ended.size(), 15u);
  std::set<std::uint64_t> numbers;
  for (const MessageOutcome& each : news.ended) {
    EXPECT_EQ(each.cause, LossCause::kPending);
    EXPECT_TRUE(numbers.insert(each.message.number).second);
  }
  EXPECT_EQ(news.ended.size() + row.outcomes.size(), row.sent());
}

TEST(MediumRadio, MessagesGrowTooOldWhereNobodyEverSends) {
  MediumRadioOptions options;
  options.profile.mac.queue_lifetime = Time::from_seconds(2);
  options.profile.mac.queue_packets = 100;
  Attack attack;
  attack.name = "eve";
  attack.place = Vec3(500, 0, -100);
  attack.power_dbm = 30;
  attack.what = Jammer{};
  options.attacks.push_back(attack);
  Row row(options);
  for (int i = 0; i < 50; ++i) {
    if (i < 10) row.send(0, 1);
    row.step();
  }
  EXPECT_EQ(row.outcomes.size(), 10u);
  for (const MessageOutcome& each : row.outcomes)
    EXPECT_EQ(each.cause, LossCause::kExpired);
  const RadioUse use = row.radio().take_statistics().radios[0];
  EXPECT_EQ(use.expired, 10u);
  EXPECT_GE(use.waiting, 9u) << "it is counted while nothing ends";
}

}  // namespace
}  // namespace skein::communication::medium_radio_test
