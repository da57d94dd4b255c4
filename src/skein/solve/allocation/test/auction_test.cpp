// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/auction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "skein/solve/allocation/search_random.h"

namespace skein::solve::auction_test {
namespace {

// Aircraft and tasks in a plane; a task is worth less the later it is reached.
struct Field {
  std::vector<std::pair<double, double>> aircraft, tasks;

  Field(std::uint64_t seed, std::size_t aircraft_count, std::size_t task_count) {
    SearchRandom random(seed, 5);
    for (std::size_t k = 0; k < aircraft_count; ++k)
      aircraft.emplace_back(random.uniform(), random.uniform());
    for (std::size_t k = 0; k < task_count; ++k)
      tasks.emplace_back(random.uniform(), random.uniform());
  }
  double value(std::size_t who, std::span<const std::uint32_t> path) const {
    auto at = aircraft[who];
    double time = 0, value = 0;
    for (const std::uint32_t t : path) {
      const double x = tasks[t].first - at.first, y = tasks[t].second - at.second;
      time += std::sqrt(x * x + y * y);
      value += std::exp(-time);
      at = tasks[t];
    }
    return value;
  }
  std::vector<Bidder> bidders(std::size_t capacity) const {
    std::vector<Bidder> all;
    for (std::size_t k = 0; k < aircraft.size(); ++k) {
      all.emplace_back(
          EntityId{static_cast<std::uint32_t>(k)}, capacity,
          [this, k](std::span<const std::uint32_t> path) { return value(k, path); });
      for (std::uint32_t t = 0; t < tasks.size(); ++t) all[k].set_task(t, 1);
    }
    return all;
  }
};

// A radio that loses, doubles and delays.
struct Air {
  double loss = 0, twice = 0;
  int longest_delay = 0;
  SearchRandom random{1, 6};
  struct Flying {
    int arrives;
    std::size_t to;
    AuctionMessage message;
  };
  std::vector<Flying> flying;

  void send(int now, std::size_t from, std::size_t count, const AuctionMessage& message) {
    for (std::size_t to = 0; to < count; ++to) {
      if (to == from || random.uniform() < loss) continue;
      const int copies = random.uniform() < twice ? 2 : 1;
      for (int c = 0; c < copies; ++c)
        flying.push_back({now + static_cast<int>(random.below(
                                    static_cast<std::size_t>(longest_delay) + 1)),
                          to, message});
    }
  }
  void deliver(int now, std::vector<Bidder>& bidders) {
    std::vector<Flying> later;
    for (const Flying& f : flying) {
      if (f.arrives > now)
        later.push_back(f);
      else
        (void)bidders[f.to].receive(f.message);
    }
    flying = later;
  }
};

void run(std::vector<Bidder>& bidders, Air& air, int from, int steps) {
  for (int now = from; now < from + steps; ++now) {
    for (std::size_t k = 0; k < bidders.size(); ++k) {
      bidders[k].build();
      air.send(now, k, bidders.size(), bidders[k].message());
    }
    air.deliver(now, bidders);
  }
}

// All say the same of every task, winners have it in their paths, nobody else does.
void expect_agreed(const std::vector<Bidder>& bidders,
                   const std::vector<std::uint32_t>& tasks, bool all_taken) {
  for (const std::uint32_t t : tasks) {
    const TaskClaim claim = *bidders[0].claim_of(t);
    if (all_taken) {
      EXPECT_TRUE(claim.taken) << "task " << t;
    }
    std::size_t holders = 0;
    for (const Bidder& bidder : bidders) {
      EXPECT_EQ(bidder.claim_of(t)->taken, claim.taken);
      EXPECT_EQ(bidder.claim_of(t)->winner, claim.winner) << "task " << t;
      const auto& path = bidder.path();
      if (std::find(path.begin(), path.end(), t) == path.end()) continue;
      ++holders;
      EXPECT_EQ(bidder.self(), claim.winner);
    }
    EXPECT_EQ(holders, claim.taken ? 1U : 0U) << "task " << t;
  }
}

std::vector<std::uint32_t> numbers(std::size_t count) {
  std::vector<std::uint32_t> all;
  for (std::uint32_t t = 0; t < count; ++t) all.push_back(t);
  return all;
}

TEST(Auction, GivesEveryTaskToOneBidder) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Field field(seed, 5, 12);
    auto bidders = field.bidders(12);
    Air air;
    run(bidders, air, 0, 30);
    expect_agreed(bidders, numbers(12), true);
  }
}

TEST(Auction, AgreesThroughLossDelayAndDuplicates) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Field field(seed, 6, 15);
    auto bidders = field.bidders(15);
    Air air;
    air.loss = 0.5;
    air.twice = 0.3;
    air.longest_delay = 8;
    air.random = SearchRandom(seed, 6);
    run(bidders, air, 0, 400);
    expect_agreed(bidders, numbers(15), true);
  }
}

// What the best pair is worth goes first, as the greedy allocation has it.
TEST(Auction, OfOneTaskEachIsTheGreedyAllocation) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Field field(seed, 6, 6);
    auto bidders = field.bidders(1);
    Air air;
    run(bidders, air, 0, 40);
    expect_agreed(bidders, numbers(6), true);
    std::map<std::size_t, std::uint32_t> greedy;
    std::vector<bool> taken(6, false);
    for (int k = 0; k < 6; ++k) {
      double most = -1;
      std::size_t who = 0;
      std::uint32_t what = 0;
      for (std::size_t a = 0; a < 6; ++a)
        for (std::uint32_t t = 0; t < 6; ++t) {
          if (greedy.contains(a) || taken[t]) continue;
          const double value = field.value(a, std::span(&t, 1));
          if (value > most) {
            most = value;
            who = a;
            what = t;
          }
        }
      greedy[who] = what;
      taken[what] = true;
    }
    for (std::size_t a = 0; a < 6; ++a)
      EXPECT_EQ(bidders[a].path(), std::vector<std::uint32_t>{greedy[a]}) << seed;
  }
}

TEST(Auction, FollowsTasksThatComeChangeAndVanish) {
  Field field(9, 4, 8);
  auto bidders = field.bidders(8);
  Air air;
  air.loss = 0.3;
  run(bidders, air, 0, 100);
  field.tasks[2] = {0.1, 0.1};  // moves
  field.tasks.emplace_back(0.9, 0.2);
  // They learn of it one after the other.
  for (std::size_t k = 0; k < bidders.size(); ++k) {
    bidders[k].set_task(2, 2);
    bidders[k].set_task(8, 1);
    bidders[k].remove_task(5);
    run(bidders, air, 100 + 3 * static_cast<int>(k), 3);
  }
  run(bidders, air, 200, 150);
  expect_agreed(bidders, {0, 1, 2, 3, 4, 6, 7, 8}, true);
  EXPECT_FALSE(bidders[0].claim_of(5).has_value());
}

TEST(Auction, TakesOverFromWhoIsGone) {
  const Field field(10, 4, 8);
  auto bidders = field.bidders(8);
  Air air;
  run(bidders, air, 0, 50);
  bidders.pop_back();
  for (Bidder& bidder : bidders) bidder.forget(EntityId{3});
  air.flying.clear();
  run(bidders, air, 100, 60);
  expect_agreed(bidders, numbers(8), true);
}

TEST(Auction, AgreesThoughValuesGrowWithTheBundle) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<Bidder> bidders;
    for (std::uint32_t k = 0; k < 4; ++k) {
      bidders.emplace_back(
          EntityId{k}, 5, [k, seed](std::span<const std::uint32_t> path) {
            double value = 0;  // pairs are worth more than their parts
            for (const std::uint32_t t : path)
              value += 1 + static_cast<double>((t * 7 + k * 5 + seed) % 11);
            return value * static_cast<double>(path.size());
          });
      for (std::uint32_t t = 0; t < 5; ++t) bidders[k].set_task(t, 1);
    }
    Air air;
    run(bidders, air, 0, 100);
    expect_agreed(bidders, numbers(5), true);
  }
}

TEST(Auction, TakesNoMalformedMessage) {
  const Field field(11, 2, 3);
  auto bidders = field.bidders(3);
  bidders[0].build();
  AuctionMessage good = bidders[0].message();
  EXPECT_FALSE(bidders[0].receive(good));  // its own
  AuctionMessage bad = good;
  bad.claims[0].bid = std::nan("");
  EXPECT_FALSE(bidders[1].receive(bad));
  bad = good;
  bad.claims.push_back(bad.claims[0]);
  EXPECT_FALSE(bidders[1].receive(bad));
  bad = good;
  bad.number = 0;
  EXPECT_FALSE(bidders[1].receive(bad));
  EXPECT_FALSE(bidders[1].claim_of(0)->taken);
  EXPECT_TRUE(bidders[1].receive(good));
  EXPECT_FALSE(bidders[1].receive(good));  // twice
  EXPECT_TRUE(bidders[1].claim_of(0)->taken);
}

}  // namespace
}  // namespace skein::solve::auction_test
