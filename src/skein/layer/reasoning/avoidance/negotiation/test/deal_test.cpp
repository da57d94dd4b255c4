// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/negotiation/deal.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "skein/base/check.h"
#include "skein/data/describe/describe.h"

namespace skein::reasoning::deal_test {
namespace {

constexpr DealRule kRules[] = {DealRule::kSum, DealRule::kProduct, DealRule::kZeuthen};

Bargain make_bargain(std::vector<double> u1, std::vector<double> u2,
                     std::vector<std::uint8_t> free) {
  return {std::move(u1), std::move(u2), std::move(free)};
}

// Utilities in steps, so that equal ones are frequent.
Bargain any_bargain() {
  const auto utilities = [](int size, int steps) {
    std::vector<double> u;
    for (int k = 0; k < size; ++k)
      u.push_back(*rc::gen::inRange(0, steps + 1) / double(steps));
    return u;
  };
  const int n = *rc::gen::inRange(1, 9), m = *rc::gen::inRange(1, 9);
  const int steps = *rc::gen::element(3, 20, 10'000);
  Bargain bargain{utilities(n, steps), utilities(m, steps), {}};
  const int share = *rc::gen::inRange(1, 10);
  for (int k = 0; k < n * m; ++k)
    bargain.free.push_back(*rc::gen::inRange(0, 10) < share ? 1 : 0);
  return bargain;
}

TEST(Deal, ThereIsNoneWithoutAFreePair) {
  for (const DealRule rule : kRules) {
    EXPECT_FALSE(agree(rule, make_bargain({1}, {1}, {0}))) << name_of(rule);
    EXPECT_FALSE(agree(rule, make_bargain({}, {}, {}))) << name_of(rule);
    const auto one = agree(rule, make_bargain({0, 0}, {0}, {0, 1}));
    ASSERT_TRUE(one) << name_of(rule);
    EXPECT_EQ(one->deal, (Deal{1, 0}));
  }
}

TEST(Deal, TheRulesDifferWhereOneGivesUpMore) {
  // (1, 0.1), (0.5, 0.5), (0.1, 1): the first has the most in sum, the second is fair.
  const Bargain bargain =
      make_bargain({1, 0.5, 0.1}, {0.1, 0.5, 1}, {1, 0, 0, 0, 1, 0, 0, 0, 1});
  EXPECT_EQ(agree(DealRule::kSum, bargain)->deal, (Deal{0, 0}));
  EXPECT_EQ(agree(DealRule::kProduct, bargain)->deal, (Deal{1, 1}));
  const auto zeuthen = agree(DealRule::kZeuthen, bargain);
  EXPECT_EQ(zeuthen->deal, (Deal{1, 1}));
  EXPECT_EQ(zeuthen->rounds, 2);  // aircraft 1 gives way first, then 2
}

TEST(Deal, OfEqualPairsTheLowestIsTaken) {
  const Bargain bargain = make_bargain({0.5, 0.5}, {0.5, 0.5}, {0, 1, 1, 1});
  for (const DealRule rule : kRules)
    EXPECT_EQ(agree(rule, bargain)->deal, (Deal{0, 1})) << name_of(rule);
}

TEST(Deal, RefusesTablesThatDoNotFit) {
  EXPECT_THROW((void)agree(DealRule::kSum, make_bargain({1}, {1}, {1, 1})), Bug);
  EXPECT_THROW((void)agree(DealRule::kSum, make_bargain({-1}, {1}, {1})), Bug);
}

TEST(Deal, NobodyGainsWithoutTheOtherLosing) {
  EXPECT_TRUE(rc::check("a deal is free and on the edge of what can be had", [] {
    const Bargain b = any_bargain();
    for (const DealRule rule : kRules) {
      const auto found = agree(rule, b);
      const bool any = std::ranges::find(b.free, 1) != b.free.end();
      RC_ASSERT(found.has_value() == any);
      if (!found) return;
      const Deal d = found->deal;
      RC_ASSERT(b.is_free(d.k, d.l));
      for (std::size_t k = 0; k < b.u1.size(); ++k)
        for (std::size_t l = 0; l < b.u2.size(); ++l)
          if (b.is_free(k, l)) RC_ASSERT(!(b.u1[k] > b.u1[d.k] && b.u2[l] > b.u2[d.l]));
    }
  }));
}

TEST(Deal, ConcessionsEndInTheLargestProduct) {
  EXPECT_TRUE(rc::check("Zeuthen's deal is Nash's", [] {
    const Bargain b = any_bargain();
    const auto product = agree(DealRule::kProduct, b);
    const auto zeuthen = agree(DealRule::kZeuthen, b);
    if (!product) return;
    const auto worth = [&](const Deal& d) { return b.u1[d.k] * b.u2[d.l]; };
    RC_ASSERT(zeuthen->rounds <= static_cast<int>(b.u1.size() + b.u2.size()));
    // Risks are quotients: rounding may decide between products that differ by less.
    RC_ASSERT(worth(zeuthen->deal) >= worth(product->deal) * (1 - 1e-12));
  }));
}

TEST(Deal, IsTheSameFromBothSides) {
  EXPECT_TRUE(rc::check("who is aircraft 1 matters only for equal pairs", [] {
    const Bargain b = any_bargain();
    Bargain mirrored{b.u2, b.u1, {}};
    for (std::size_t l = 0; l < b.u2.size(); ++l)
      for (std::size_t k = 0; k < b.u1.size(); ++k)
        mirrored.free.push_back(b.is_free(k, l) ? 1 : 0);
    for (const DealRule rule : {DealRule::kSum, DealRule::kProduct}) {
      const auto found = agree(rule, b), other = agree(rule, mirrored);
      if (!found) return;
      const auto value = [&](double first, double second) {
        return rule == DealRule::kSum ? first + second : first * second;
      };
      RC_ASSERT(value(b.u1[found->deal.k], b.u2[found->deal.l]) ==
                value(mirrored.u1[other->deal.k], mirrored.u2[other->deal.l]));
    }
  }));
}

}  // namespace
}  // namespace skein::reasoning::deal_test
