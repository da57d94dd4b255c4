// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "skein/link/modem/duplicates.h"
#include "skein/link/modem/neighbour_table.h"

namespace skein::modem::neighbours_test {
namespace {

Time seconds(double s) {
  return Time::from_seconds(s);
}

TEST(NeighbourTable, FindsAndLosesAfterItsPatience) {
  NeighbourTable table(3, seconds(3));
  std::vector<NeighbourChange> changes;
  table.advertised({7, 1}, seconds(0), changes);
  table.advertised({7, 1}, seconds(1), changes);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_TRUE(changes[0].found);
  EXPECT_EQ(table.find(EntityId{1}), (Address{7, 1}));
  table.step(seconds(4), changes);
  EXPECT_EQ(changes.size(), 1u);
  EXPECT_TRUE(table.heard({7, 1}, seconds(4))) << "any word of it counts";
  table.step(seconds(7), changes);
  EXPECT_EQ(changes.size(), 1u);
  table.step(seconds(7.1), changes);
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_FALSE(changes[1].found);
  EXPECT_FALSE(table.find(EntityId{1}));
  EXPECT_FALSE(table.heard({7, 1}, seconds(8)))
      << "only its advertisement brings it back";
  table.advertised({7, 1}, seconds(8), changes);
  EXPECT_TRUE(table.find(EntityId{1}));
}

TEST(NeighbourTable, KeepsTheFirstOfTwoAndKnowsNobodyElse) {
  NeighbourTable table(3, seconds(3));
  std::vector<NeighbourChange> changes;
  table.advertised({7, 1}, seconds(0), changes);
  table.advertised({8, 1}, seconds(1), changes);
  EXPECT_EQ(table.find(EntityId{1}), (Address{7, 1}));
  EXPECT_FALSE(table.heard({8, 1}, seconds(1)));
  table.advertised({8, 3}, seconds(1), changes);
  table.advertised({kAll, 2}, seconds(1), changes);
  EXPECT_EQ(changes.size(), 1u);
}

TEST(NeighbourTable, SaysWhomItTakesAndWhichModemsItNeeds) {
  NeighbourTable table(3, seconds(3));
  std::vector<NeighbourChange> changes;
  EXPECT_TRUE(table.takes({7, 1}));
  EXPECT_FALSE(table.takes({7, 3}) || table.takes({kAll, 1}));
  table.advertised({7, 1}, seconds(0), changes);
  EXPECT_TRUE(table.takes({7, 1}) && table.reaches_through(7));
  EXPECT_FALSE(table.takes({8, 1}) || table.reaches_through(8));
}

constexpr Time kPatience = Time::from_ns(3'000'000'000);

TEST(Duplicates, AreToldFromWhatIsNew) {
  Duplicates seen(SessionRule::kFirst, kPatience);
  for (const std::uint64_t number : {1u, 3u, 2u, 70u, 7u, 100u})
    EXPECT_TRUE(seen.is_new(1, 5, number, seconds(0))) << number;
  for (const std::uint64_t number : {3u, 70u, 100u, 7u, 1u, 30u})
    EXPECT_FALSE(seen.is_new(1, 5, number, seconds(0))) << number;
  EXPECT_TRUE(seen.is_new(2, 5, 3, seconds(0))) << "another origin";
}

TEST(Duplicates, AreFoundAtTheEdgeOfTheWindow) {
  for (std::uint64_t ahead = 1; ahead < 70; ++ahead) {
    Duplicates seen(SessionRule::kFirst, kPatience);
    EXPECT_TRUE(seen.is_new(1, 5, 10, seconds(0)));
    EXPECT_TRUE(seen.is_new(1, 5, 10 + ahead, seconds(0)));
    EXPECT_FALSE(seen.is_new(1, 5, 10, seconds(0))) << ahead;
  }
}

TEST(Duplicates, KeepToTheFirstSessionWhileItIsHeard) {
  Duplicates seen(SessionRule::kFirst, kPatience);
  EXPECT_TRUE(seen.is_new(1, 5, 1, seconds(0)));
  EXPECT_FALSE(seen.is_new(1, ~std::uint64_t{0}, 1, seconds(1))) << "made up";
  EXPECT_TRUE(seen.is_new(1, 5, 2, seconds(2)));
  EXPECT_TRUE(seen.is_new(1, 4, 1, seconds(5.5))) << "the other is silent";
  seen.lost(1);
  EXPECT_TRUE(seen.is_new(1, 3, 1, seconds(5.6)));
}

TEST(Duplicates, KeepToTheNewestSessionWhereNoneCanBeMadeUp) {
  Duplicates seen(SessionRule::kNewest, kPatience);
  EXPECT_TRUE(seen.is_new(1, 5, 9, seconds(0)));
  EXPECT_TRUE(seen.is_new(1, 6, 3, seconds(1))) << "it began anew";
  seen.lost(1);
  EXPECT_FALSE(seen.is_new(1, 5, 10, seconds(100))) << "of before";
  EXPECT_FALSE(seen.is_new(1, 6, 3, seconds(100)));
}

}  // namespace
}  // namespace skein::modem::neighbours_test
