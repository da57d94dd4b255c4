// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/orders.h"

#include <gtest/gtest.h>

namespace skein::reasoning::orders_test {
namespace {

constexpr EntityId kMaster{1}, kA{2}, kB{3};
constexpr double kRepeat = 0.3, kPeriod = 1, kPatience = 4;

TeamOrders::Outcome step(TeamOrders& orders, double now) {
  return orders.step(now, kRepeat, kPeriod, kPatience);
}

TEST(TeamOrders, AreRepeatedUntilTheyAreAcknowledged) {
  TeamOrders orders(kMaster);
  orders.set(kA, {7});
  ASSERT_EQ(step(orders, 0).sent.size(), 1u);
  int sent = 1;
  bool reported = false;
  for (int k = 1; k <= 60; ++k) {
    const auto outcome = step(orders, 0.1 * k);
    for (const auto& order : outcome.sent) EXPECT_EQ(order.number, 1u);
    sent += static_cast<int>(outcome.sent.size());
    if (!outcome.unanswered.empty()) {
      EXPECT_FALSE(reported) << "once is enough";
      EXPECT_GT(0.1 * k, kPatience);
      reported = true;
    }
  }
  EXPECT_TRUE(reported);
  EXPECT_GE(sent, 1 + 3 + 4);
  EXPECT_LE(sent, 1 + 3 + 6);
  EXPECT_FALSE(orders.all_acknowledged());
  EXPECT_FALSE(orders.acknowledge(kA, 2)) << "there was no such order";
  EXPECT_FALSE(orders.acknowledge(kB, 1));
  EXPECT_TRUE(orders.acknowledge(kA, 1));
  EXPECT_TRUE(orders.acknowledge(kA, 1)) << "twice is once";
  EXPECT_TRUE(orders.all_acknowledged());
  EXPECT_TRUE(step(orders, 20).sent.empty());
}

TEST(TeamOrders, WhatStandsBehindATaskThatAnotherHasWaitsWithIt) {
  TeamOrders orders(kMaster);
  orders.set(kA, {7});
  step(orders, 0);
  orders.acknowledge(kA, 1);
  orders.set(kA, {});
  orders.set(kB, {5, 7, 8});
  auto outcome = step(orders, 1);
  ASSERT_EQ(outcome.sent.size(), 2u);
  EXPECT_EQ(outcome.sent[1].tasks, (std::vector<std::uint32_t>{5}));
  orders.acknowledge(kA, outcome.sent[0].number);
  outcome = step(orders, 1.1);
  ASSERT_EQ(outcome.sent.size(), 1u);
  EXPECT_EQ(outcome.sent[0].tasks, (std::vector<std::uint32_t>{5, 7, 8}));
}

TEST(TeamOrders, TakeATaskFromOneBeforeTheOtherGetsIt) {
  TeamOrders orders(kMaster);
  orders.set(kA, {7});
  orders.set(kB, {});
  step(orders, 0);
  orders.acknowledge(kA, 1);
  orders.acknowledge(kB, 2);
  orders.set(kA, {});
  orders.set(kB, {7});
  auto outcome = step(orders, 1);
  ASSERT_EQ(outcome.sent.size(), 1u);
  EXPECT_EQ(outcome.sent[0].to, kA);
  EXPECT_TRUE(outcome.sent[0].tasks.empty());
  EXPECT_TRUE(step(orders, 1.1).sent.empty());
  orders.acknowledge(kA, 3);
  outcome = step(orders, 1.2);
  ASSERT_EQ(outcome.sent.size(), 1u);
  EXPECT_EQ(outcome.sent[0].to, kB);
  EXPECT_EQ(outcome.sent[0].tasks, std::vector<std::uint32_t>{7});
}

TEST(TeamOrders, GiveTasksOfTheLostAtOnce) {
  TeamOrders orders(kMaster);
  orders.set(kA, {7});
  orders.set(kMaster, {});
  step(orders, 0);
  orders.acknowledge(kA, 1);
  orders.remove(kA);
  orders.set(kMaster, {7});
  step(orders, 5);
  EXPECT_EQ(orders.own(), std::vector<std::uint32_t>{7});
}

TEST(TeamOrders, AreGivenAgainToWhoHasDroppedThem) {
  TeamOrders orders(kMaster);
  orders.set(kA, {7});
  step(orders, 0);
  orders.acknowledge(kA, 1);
  orders.informed(kA, {7});
  EXPECT_TRUE(step(orders, 1).sent.empty());
  orders.informed(kA, {});
  const auto outcome = step(orders, 2);
  ASSERT_EQ(outcome.sent.size(), 1u);
  EXPECT_EQ(outcome.sent[0].number, 1u);
}

TEST(TeamOrders, AskTheSilentOnceMore) {
  TeamOrders orders(kMaster);
  orders.set(kA, {7});
  step(orders, 0);
  orders.acknowledge(kA, 1);
  orders.remind(kA);
  EXPECT_EQ(step(orders, 2).sent.size(), 1u);
  EXPECT_TRUE(orders.all_acknowledged()) << "it was";
}

TEST(TeamOrders, WhoLeadsAgainDoesNotBeginWhatItHadThen) {
  TeamOrders orders(kMaster);
  orders.set(kMaster, {7});
  step(orders, 0);
  ASSERT_EQ(orders.own(), std::vector<std::uint32_t>{7});
  orders.clear();
  step(orders, 5);
  EXPECT_TRUE(orders.own().empty());
}

}  // namespace
}  // namespace skein::reasoning::orders_test
