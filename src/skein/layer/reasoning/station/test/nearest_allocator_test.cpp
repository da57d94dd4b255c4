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
