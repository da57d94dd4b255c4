// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/ideal_radio.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace skein::communication::ideal_radio_test {
namespace {

Message message(std::uint32_t from, std::uint64_t number, double sent,
                std::uint32_t to = 9) {
  Message m;
  m.from = {from};
  m.to = {to};
  m.number = number;
  m.sent = Time::from_seconds(sent);
  return m;
}

struct Delivery {
  std::vector<Message> arrived, lost;
};
Delivery deliver(IdealRadio& radio, double now) {
  Delivery d;
  RadioNews news;
  radio.deliver(Time::from_seconds(now), news);
  for (const MessageOutcome& each : news.ended)
    (each.cause == LossCause::kNone ? d.arrived : d.lost).push_back(each.message);
  return d;
}

TEST(IdealRadio, DeliversAtOnceInTheOrderOfSending) {
  IdealRadio radio({}, 1);
  for (std::uint32_t i = 0; i < 20; ++i) radio.send(message(i, 5, 1.0));
  const Delivery d = deliver(radio, 1.0);
  ASSERT_EQ(d.arrived.size(), 20U);
  for (std::uint32_t i = 0; i < 20; ++i) EXPECT_EQ(d.arrived[i].from.value, i);
  EXPECT_TRUE(deliver(radio, 2.0).arrived.empty());
}

TEST(IdealRadio, HoldsMessagesForTheDelay) {
  IdealRadio radio({.delay = 0.5}, 1);
  radio.send(message(1, 0, 1.0));
  radio.send(message(1, 1, 1.2));
  EXPECT_TRUE(deliver(radio, 1.499).arrived.empty());
  EXPECT_EQ(deliver(radio, 1.5).arrived.size(), 1U);
  EXPECT_EQ(deliver(radio, 3).arrived.size(), 1U);
}

TEST(IdealRadio, ArrivalsComeInOrderOfTime) {
  IdealRadio radio({.delay = 0.1, .jitter = 2}, 3);
  for (std::uint64_t i = 0; i < 200; ++i)
    radio.send(message(1, i, 0.01 * static_cast<double>(i)));
  std::vector<std::uint64_t> order;
  double latest = 0;
  for (double now = 0; now < 5; now += 0.05) {
    for (const Message& m : deliver(radio, now).arrived) {
      order.push_back(m.number);
      const double waited = now - m.sent.seconds();
      EXPECT_GE(waited, 0.1 - 1e-9);
      EXPECT_LE(waited, 2.1 + 0.05 + 1e-9);  // delivered at steps of 0.05 s
      latest = std::max(latest, waited);
    }
  }
  EXPECT_EQ(order.size(), 200U);
  EXPECT_FALSE(std::is_sorted(order.begin(), order.end()));
  EXPECT_GT(latest, 1.9);
}

TEST(IdealRadio, LosesTheStatedShareAndSaysWhich) {
  IdealRadio radio({.loss = 0.2}, 4);
  const std::size_t n = 10000;
  for (std::uint64_t i = 0; i < n; ++i) radio.send(message(1, i, 0));
  const Delivery d = deliver(radio, 0);
  EXPECT_EQ(d.arrived.size() + d.lost.size(), n);
  EXPECT_NEAR(static_cast<double>(d.lost.size()), 2000, 4 * 40);  // sd 40
}

TEST(IdealRadio, FateOfAMessageDependsOnNoOther) {
  const IdealRadioOptions options{.delay = 0.1, .jitter = 1, .loss = 0.3};
  std::map<std::pair<std::uint32_t, std::uint64_t>, bool> together;
  IdealRadio radio(options, 5);
  for (std::uint32_t from = 0; from < 10; ++from)
    for (std::uint64_t i = 0; i < 20; ++i) radio.send(message(from, i, 0));
  const Delivery d = deliver(radio, 0.6);
  for (const Message& m : d.arrived) together[{m.from.value, m.number}] = true;
  for (std::uint32_t from = 10; from-- > 0;) {
    for (std::uint64_t i = 20; i-- > 0;) {
      IdealRadio alone(options, 5);
      alone.send(message(from, i, 0));
      EXPECT_EQ(deliver(alone, 0.6).arrived.size(), together.count({from, i}));
    }
  }
}

TEST(IdealRadio, KeepsItsRange) {
  const auto position = [](EntityId id) -> std::optional<Vec3> {
    if (id.value == 9) return std::nullopt;  // has no position
    return Vec3(100.0 * id.value, 0, 0);
  };
  IdealRadio radio({.range = 250}, 1, position);
  radio.send(message(1, 0, 0, 3));
  radio.send(message(1, 1, 0, 4));
  radio.send(message(1, 2, 0, 9));
  const Delivery d = deliver(radio, 0);
  ASSERT_EQ(d.arrived.size(), 2U);
  EXPECT_EQ(d.arrived[0].to.value, 3U);
  EXPECT_EQ(d.arrived[1].to.value, 9U);
  ASSERT_EQ(d.lost.size(), 1U);
  EXPECT_EQ(d.lost[0].to.value, 4U);
}

TEST(IdealRadio, LosesWhatIsSentInAnOutageOfEitherModem) {
  // A third of the time out, in spans of 30 s: 1,000 cycles of 90 s.
  IdealRadio radio({.outages_per_hour = 60, .outage_mean = 30}, 6);
  const std::uint64_t n = 90000;
  for (std::uint64_t i = 0; i < n; ++i) radio.send(message(1, i, double(i)));
  const Delivery d = deliver(radio, double(n));
  // Both modems work for 4/9 of the time; its standard error is below 0.016.
  EXPECT_NEAR(double(d.arrived.size()) / double(n), 4.0 / 9, 0.06);
  std::vector<bool> heard(n);
  for (const Message& m : d.arrived) heard[m.number] = true;
  int changes = 0;
  for (std::size_t i = 1; i < n; ++i) changes += heard[i] != heard[i - 1] ? 1 : 0;
  EXPECT_LT(changes, 5000);  // in spans: by chance for each alone it would be 44,000
}

TEST(IdealRadio, OutagesOfOneModemDoNotTouchOthers) {
  const IdealRadioOptions options{.outages_per_hour = 60, .outage_mean = 30};
  IdealRadio alone(options, 7), together(options, 7);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    alone.send(message(1, i, double(i), 2));
    together.send(message(3, i, double(i), 4));
    together.send(message(1, i, double(i), 2));
  }
  std::vector<std::uint64_t> first, second;
  for (const Message& m : deliver(alone, 2000).arrived) first.push_back(m.number);
  for (const Message& m : deliver(together, 2000).arrived)
    if (m.from.value == 1) second.push_back(m.number);
  EXPECT_EQ(first, second);
  EXPECT_LT(first.size(), 2000u);
  EXPECT_GT(first.size(), 100u);
}

TEST(IdealRadio, KeepsTheContent) {
  IdealRadio radio({.delay = 1}, 1);
  Message m = message(1, 0, 0);
  m.content = Task{7, FollowLine{{{1, 2}, {3, 4}}}};
  radio.send(m);
  const Delivery d = deliver(radio, 1);
  ASSERT_EQ(d.arrived.size(), 1U);
  const Task& task = std::get<Task>(d.arrived[0].content);
  EXPECT_EQ(task.number, 7U);
  EXPECT_EQ(std::get<FollowLine>(task.what).points[1], Vec2(3, 4));
}

}  // namespace
}  // namespace skein::communication::ideal_radio_test
