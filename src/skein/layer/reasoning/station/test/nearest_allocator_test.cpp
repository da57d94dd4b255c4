// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/station/nearest_allocator.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "skein/base/random.h"

namespace skein::reasoning::nearest_allocator_test {
namespace {

using Owners = std::vector<std::optional<std::size_t>>;

std::vector<AllocatedAircraft> in_a_row(std::uint32_t count) {
  std::vector<AllocatedAircraft> all;
  for (std::uint32_t k = 0; k < count; ++k)
    all.push_back({EntityId{k + 1}, Vec2(100.0 * k, 0), std::nullopt});
  return all;
}

WantingMission mission(const std::vector<AllocatedAircraft>& who, int priority, int min,
                       int max, const Vec2& place) {
  WantingMission wanting{{min, max, place}, priority, {}};
  for (const AllocatedAircraft& each : who) wanting.candidates.push_back(each.id);
  return wanting;
}

// One of so many.
std::size_t pick(RandomStream& random, std::size_t count) {
  return std::min(
      count - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(count)));
}

TEST(NearestAllocator, GivesTheNearestToWhomNeedsThemAndSharesTheRest) {
  const auto who = in_a_row(6);
  const Owners owners = NearestAllocator().allocate(
      who, {mission(who, 0, 1, 100, {0, 0}), mission(who, 0, 2, 100, {500, 0})});
  EXPECT_EQ(owners, (Owners{0, 0, 0, 1, 1, 1}));
}

TEST(NearestAllocator, ChangesNothingWithoutAReason) {
  auto who = in_a_row(4);
  for (std::size_t k = 0; k < 4; ++k) who[k].owner = k % 2;
  const Owners owners = NearestAllocator().allocate(
      who, {mission(who, 0, 1, 100, {0, 0}), mission(who, 0, 1, 100, {300, 0})});
  EXPECT_EQ(owners, (Owners{0, 1, 0, 1}));
}

TEST(NearestAllocator, TakesForTheMoreImportantFromTheLessImportantOnly) {
  auto who = in_a_row(3);
  for (AllocatedAircraft& each : who) each.owner = 0;
  const auto share = [&](int priority) {
    return NearestAllocator().allocate(
        who, {mission(who, 0, 1, 100, {0, 0}), mission(who, priority, 1, 1, {110, 0})});
  };
  EXPECT_EQ(share(1), (Owners{0, 1, 0}));
  EXPECT_EQ(share(0), (Owners{0, 0, 0}));
}

// The definition, word by word: who may be taken is looked for anew each time.
Owners by_definition(const std::vector<AllocatedAircraft>& who,
                     const std::vector<WantingMission>& missions) {
  Owners owners;
  for (const AllocatedAircraft& each : who) owners.push_back(each.owner);
  const auto may_fly = [&](std::size_t k, std::size_t m) {
    return std::count(missions[m].candidates.begin(), missions[m].candidates.end(),
                      who[k].id) > 0;
  };
  const auto distance = [&](std::size_t k, std::size_t m) {
    return (who[k].place - *missions[m].demand.place).norm();
  };
  const auto count = [&](std::size_t m) {
    return std::count(owners.begin(), owners.end(), std::optional(m));
  };
  const auto take = [&](std::size_t m, bool free) {
    std::optional<std::size_t> best;
    for (std::size_t k = 0; k < who.size(); ++k) {
      if (!may_fly(k, m) || owners[k].has_value() == free) continue;
      if (!free && missions[*owners[k]].priority >= missions[m].priority) continue;
      if (!best || distance(k, m) < distance(*best, m)) best = k;
    }
    if (best) owners[*best] = m;
    return best.has_value();
  };
  std::vector<std::size_t> order;
  for (std::size_t m = 0; m < missions.size(); ++m) order.push_back(m);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return missions[a].priority > missions[b].priority;
  });
  for (std::size_t k = 0; k < who.size(); ++k)
    if (owners[k] && !may_fly(k, *owners[k])) owners[k].reset();
  for (std::size_t m = 0; m < missions.size(); ++m)
    while (count(m) > missions[m].demand.max) {
      std::size_t farthest = who.size();
      for (std::size_t k = 0; k < who.size(); ++k)
        if (owners[k] == m &&
            (farthest == who.size() || distance(k, m) >= distance(farthest, m)))
          farthest = k;
      owners[farthest].reset();
    }
  for (const std::size_t m : order)
    while (count(m) < missions[m].demand.min && (take(m, true) || take(m, false))) {
    }
  for (bool given = true; given;) {
    given = false;
    for (const std::size_t m : order)
      if (count(m) >= missions[m].demand.min && count(m) < missions[m].demand.max)
        given = take(m, true) || given;
  }
  return owners;
}

TEST(NearestAllocator, GivesWhatTheDefinitionSays) {
  RandomStream random(6, 0, Purpose::kTest, 0);
  for (int round = 0; round < 500; ++round) {
    auto who = in_a_row(1 + static_cast<std::uint32_t>(pick(random, 12)));
    std::vector<WantingMission> missions;
    const std::size_t count = 1 + pick(random, 4);
    for (std::size_t m = 0; m < count; ++m) {
      const int min = static_cast<int>(pick(random, 4));
      // Places on a lattice, so that distances are equal, too.
      missions.push_back(mission(who, static_cast<int>(pick(random, 3)), min,
                                 min + static_cast<int>(pick(random, 5)),
                                 {50.0 * static_cast<double>(pick(random, 16)), 0}));
      std::erase_if(missions.back().candidates,
                    [&](EntityId) { return random.uniform() < 0.3; });
    }
    for (AllocatedAircraft& each : who)
      if (random.uniform() < 0.6) each.owner = pick(random, count);
    EXPECT_EQ(NearestAllocator().allocate(who, missions), by_definition(who, missions))
        << round;
  }
}

// Five thousand in the time of a sort: looking for each anew took half a minute.
TEST(NearestAllocator, SharesFiveThousandAircraft) {
  const auto who = in_a_row(5000);
  std::vector<WantingMission> missions;
  for (int m = 0; m < 4; ++m)
    missions.push_back(mission(who, m, 100, 2000, {30'000.0 * m, 0}));
  const Owners owners = NearestAllocator().allocate(who, missions);
  EXPECT_EQ(std::count(owners.begin(), owners.end(), std::nullopt), 0);
}

TEST(NearestAllocator, KeepsItsWordForAnyNeeds) {
  RandomStream random(5, 0, Purpose::kTest, 0);
  for (int round = 0; round < 300; ++round) {
    auto who = in_a_row(1 + static_cast<std::uint32_t>(pick(random, 8)));
    std::vector<WantingMission> missions;
    const std::size_t count = 1 + pick(random, 4);
    for (std::size_t m = 0; m < count; ++m) {
      const int min = static_cast<int>(pick(random, 3));
      missions.push_back(mission(who, static_cast<int>(pick(random, 3)), min,
                                 min + static_cast<int>(pick(random, 4)),
                                 {800 * random.uniform(), 0}));
      std::erase_if(missions.back().candidates,
                    [&](EntityId) { return random.uniform() < 0.3; });
    }
    for (AllocatedAircraft& each : who)
      if (random.uniform() < 0.5) each.owner = pick(random, count);
    const Owners owners = NearestAllocator().allocate(who, missions);
    ASSERT_EQ(owners.size(), who.size());
    for (std::size_t k = 0; k < who.size(); ++k) {
      if (!owners[k]) {
        // Free ones are of no use to anybody.
        for (std::size_t m = 0; m < count; ++m) {
          const auto& may = missions[m].candidates;
          if (std::count(may.begin(), may.end(), who[k].id) == 0) continue;
          const auto has = std::count(owners.begin(), owners.end(), std::optional(m));
          EXPECT_TRUE(has >= missions[m].demand.max || has < missions[m].demand.min)
              << round;
          EXPECT_FALSE(has < missions[m].demand.min) << round;
        }
        continue;
      }
      const auto& may = missions[*owners[k]].candidates;
      EXPECT_GT(std::count(may.begin(), may.end(), who[k].id), 0);
      EXPECT_LE(std::count(owners.begin(), owners.end(), owners[k]),
                missions[*owners[k]].demand.max);
    }
  }
}

}  // namespace
}  // namespace skein::reasoning::nearest_allocator_test
