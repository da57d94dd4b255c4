#include <gtest/gtest.h>

#include "skein/link/modem/duplicates.h"
#include "skein/link/modem/neighbour_table.h"

namespace skein::modem {
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

TEST(Duplicates, AreToldFromWhatIsNew) {
  Duplicates seen;
  for (const std::uint64_t number : {1u, 3u, 2u, 70u, 6u, 100u})
    EXPECT_TRUE(seen.is_new(1, 5, number, seconds(0))) << number;
  for (const std::uint64_t number : {3u, 70u, 100u, 6u, 1u, 30u})
    EXPECT_FALSE(seen.is_new(1, 5, number, seconds(0))) << number;
  EXPECT_TRUE(seen.is_new(2, 5, 3, seconds(0))) << "another origin";
  EXPECT_TRUE(seen.is_new(1, 6, 3, seconds(1))) << "it began anew";
  EXPECT_FALSE(seen.is_new(1, 5, 200, seconds(2))) << "of before";
}

TEST(Duplicates, HoldsNoMoreThanItSays) {
  Duplicates seen;
  std::size_t taken = 0;
  for (std::uint32_t origin = 0; origin < 5000; ++origin)
    taken += seen.is_new(origin, 1, 1, seconds(0)) ? 1 : 0;
  EXPECT_EQ(taken, 1000u);
}

}  // namespace
}  // namespace skein::modem
