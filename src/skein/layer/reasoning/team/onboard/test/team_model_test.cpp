// SPDX-License-Identifier: Apache-2.0
// A team as it flies, on a radio that loses, duplicates, delays and reorders messages:
// what becomes of it is compared with a model.
#include <gtest/gtest.h>

#include "skein/layer/reasoning/team/onboard/test/random_team.h"

namespace skein::reasoning::team_model_test {
namespace {

constexpr int kChapters = 12;  // each with some changes, and then quiet

TeamConfig config_of(TeamStructure structure, const RandomTeam::Size& size = {}) {
  TeamConfig config;
  config.structure = structure;
  if (structure == TeamStructure::kMaster) config.operators = {TeamWorld::kStation};
  if (structure == TeamStructure::kFixedMaster) config.fixed_leader = TeamWorld::kStation;
  config.times.mission_diameter = 0;
  config.times.radio_range = 0;
  config.allocation_period = 5;
  for (std::uint32_t id = 0; id <= size.most; ++id) config.known.insert(EntityId{id});
  return config;
}

// Seeds from 1 on, until the first that goes wrong.
void play(const TeamConfig& config, std::uint64_t seeds, std::uint64_t min_events,
          TaskSharing sharing = TaskSharing::kCoalitions,
          const RandomTeam::Size& size = {}) {
  std::uint64_t events = 0;
  std::size_t done = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    RandomTeam team(seed, config, sharing, size);
    for (int chapter = 1; chapter <= kChapters; ++chapter)
      ASSERT_EQ(team.play_chapter(), "")
          << "seed " << seed << ", chapter " << chapter << ", " << team.now() << " s\n"
          << team.story();
    events += team.events();
    done += team.done();
  }
  EXPECT_GE(events, min_events);
  EXPECT_GE(done, 3 * seeds) << "all that was quiet was idle, too";
}

TEST(TeamModel, EachFollowerHasATaskWhateverHappens) {
  play(config_of(TeamStructure::kMaster), 100, 500'000);
}

// Most of what followers say again and again they leave out.
TEST(TeamModel, EachFollowerOfALargeTeamHasATask) {
  constexpr RandomTeam::Size kLarge{25, 40};
  play(config_of(TeamStructure::kMaster, kLarge), 3, 300'000, TaskSharing::kNearest,
       kLarge);
}

TEST(TeamModel, EachHasATaskThatTheOperatorApproves) {
  TeamConfig config = config_of(TeamStructure::kMaster);
  config.approval = true;
  play(config, 50, 200'000);
}

TEST(TeamModel, NobodyFliesATaskTwiceInSequences) {
  play(config_of(TeamStructure::kMaster), 20, 80'000, TaskSharing::kSequences);
}

TEST(TeamModel, EachHasATaskInAnAuction) {
  play(config_of(TeamStructure::kAuction), 50, 500'000);
}

TEST(TeamModel, EachHasATaskWhereTheStationLeads) {
  play(config_of(TeamStructure::kFixedMaster), 50, 200'000);
}

}  // namespace
}  // namespace skein::reasoning::team_model_test
