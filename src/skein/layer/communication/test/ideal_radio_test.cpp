#include "skein/layer/communication/ideal_radio.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace skein::communication {
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
  radio.deliver(Time::from_seconds(now), d.arrived, d.lost);
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
}  // namespace skein::communication
