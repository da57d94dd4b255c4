// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/auction.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace skein::reasoning::auction_test {
namespace {

TEST(Auction, EndsWithoutConflictAndGivesAllThatCanBeGiven) {
  EXPECT_TRUE(rc::check("all agree on who flies what", [] {
    const auto members = static_cast<std::uint32_t>(*rc::gen::inRange(1, 7));
    const auto count = static_cast<std::uint32_t>(*rc::gen::inRange(1, 9));
    const auto bundle = static_cast<std::size_t>(*rc::gen::inRange(1, 4));
    const auto place = [] {
      return Vec2(*rc::gen::inRange(0, 2000), *rc::gen::inRange(0, 2000));
    };
    std::vector<TeamTask> tasks(count);
    for (std::uint32_t k = 0; k < count; ++k) tasks[k] = {k + 1, place()};
    std::vector<TeamResources> resources(members);
    for (TeamResources& one : resources) one.place.head<2>() = place();
    std::vector<Auction> auctions(members);
    // As many exchanges as there are tasks to be won, one after the other.
    for (std::uint32_t round = 0; round < members * count + 2; ++round) {
      std::vector<std::vector<TeamBid>> said(members);
      for (std::uint32_t k = 0; k < members; ++k) {
        auctions[k].bid({k}, resources[k], tasks, nearness, bundle);
        said[k] = auctions[k].known({k});
      }
      for (std::uint32_t k = 0; k < members; ++k)
        for (std::uint32_t other = 0; other < members; ++other)
          if (other != k) auctions[k].take({k}, {{"M"}, said[other]});
    }
    std::set<std::uint32_t> won;
    std::size_t sum = 0;
    for (std::uint32_t k = 0; k < members; ++k) {
      RC_ASSERT(!auctions[k].bid({k}, resources[k], tasks, nearness, bundle));
      for (const std::uint32_t task : auctions[k].won()) won.insert(task);
      sum += auctions[k].won().size();
    }
    RC_ASSERT(won.size() == sum);
    RC_ASSERT(sum == std::min<std::size_t>(count, members * bundle));
  }));
}

TEST(Auction, DropsWhatTheLostHaveBid) {
  const std::vector<TeamTask> tasks = {{1, {0, 0}}};
  Auction auction;
  auction.take({5}, {{"M"}, {{1, EntityId{2}, 1, 1}}});
  auction.bid({5}, {}, tasks, nearness, 1);
  EXPECT_TRUE(auction.won().empty());
  auction.drop({2});
  EXPECT_TRUE(auction.bid({5}, {}, tasks, nearness, 1));
  EXPECT_EQ(auction.won(), std::vector<std::uint32_t>{1});
}

TEST(Auction, WhoBeganAnewOutdatesWhatItBidBefore) {
  const std::vector<TeamTask> tasks = {{1, {0, 0}}};
  Auction other, anew;
  other.take({5}, {{"M"}, {{9, EntityId{2}, 1, 7}}});
  anew.bid({2}, {}, tasks, nearness, 1);
  anew.take({2}, {{"M"}, other.known({5})});
  other.take({5}, {{"M"}, anew.known({2})});
  const auto known = other.known({5});
  const auto bid = std::ranges::find(known, EntityId{2}, &TeamBid::winner);
  ASSERT_NE(bid, known.end());
  EXPECT_EQ(bid->task, 1u);
  EXPECT_EQ(bid->round, 8u);
}

}  // namespace
}  // namespace skein::reasoning::auction_test
