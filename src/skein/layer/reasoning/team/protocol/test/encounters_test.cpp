// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/encounters.h"

#include <gtest/gtest.h>

#include "skein/layer/reasoning/team/protocol/branches.h"
#include "skein/layer/reasoning/team/protocol/test/lone_member.h"

namespace skein::reasoning::encounters_test {
namespace {

constexpr EntityId kLower{1}, kHigher{2};
constexpr double kNow = 1000;  // [s]

struct Leader : LoneMember {
  TeamEncounters part;
  TeamBranches branches;
  double led;  // [s]

  Leader(EntityId self, double for_so_long, TeamConfig config = {})
      : LoneMember(self, std::move(config)), led(for_so_long) {
    state.role = TeamRole::kLeading;
    state.knowledge.submit(tasks_in_a_row(4));
    at(kNow);
  }
  TeamTransition meets(const Leader& other) {
    const TeamQuery query = receive_query(other.state.self, other.led);
    return part.meet(state, other.state.self, query, kNow - led, branches);
  }
};

TEST(TeamEncounters, OfTwoLeadersExactlyOneGivesWay) {
  for (const double lower_led : {1.0, 500.0})
    for (const double higher_led : {1.0, 500.0}) {
      Leader lower(kLower, lower_led), higher(kHigher, higher_led);
      const bool lower_yields = !is_none(lower.meets(higher));
      const bool higher_yields = !is_none(higher.meets(lower));
      EXPECT_NE(lower_yields, higher_yields) << lower_led << " " << higher_led;
      EXPECT_EQ(lower_yields, lower_led < higher_led);
      Leader& stays = lower_yields ? higher : lower;
      EXPECT_TRUE(stays.part.is_held(stays.state)) << "it waits for the other";
    }
}

TEST(TeamEncounters, AStationGivesWayToAnAircraft) {
  TeamConfig config;
  config.operators = {kLower};
  Leader station(kLower, 500, config), aircraft(kHigher, 1, config);
  EXPECT_FALSE(is_none(station.meets(aircraft)));
  EXPECT_TRUE(is_none(aircraft.meets(station)));
}

TEST(TeamEncounters, AFixedLeaderNeverGivesWay) {
  TeamConfig config;
  config.structure = TeamStructure::kFixedMaster;
  Leader fixed(kHigher, 500, config), other(kLower, 500, config);
  EXPECT_TRUE(is_none(fixed.meets(other)));
}

TEST(TeamEncounters, ARivalThatIsSilentHoldsNobody) {
  Leader lower(kLower, 500), higher(kHigher, 500);
  EXPECT_TRUE(is_none(lower.meets(higher)));
  lower.at(kNow + lower.state.lost + 1);
  EXPECT_FALSE(lower.part.is_held(lower.state));
}

TEST(TeamEncounters, OfTheSecondEncounterEachTaskHasOneBranch) {
  Leader lower(kLower, 500), higher(kHigher, 500);
  for (Leader* leader : {&lower, &higher})
    leader->state.knowledge.note({kLower, kHigher, 1});
  EXPECT_TRUE(is_none(higher.meets(lower)));
  ASSERT_TRUE(higher.part.waits_for_split());
  const auto asked = higher.take_sent<TeamMerge>();
  ASSERT_EQ(asked.size(), 1u);
  ASSERT_TRUE(asked.front().split);

  const auto tasks = lower.branches.open_tasks(lower.state);
  lower.part.answer_split(lower.state, kHigher, asked.front(), tasks,
                          std::vector{lower.state.own_worker()}, lower.branches);
  for (const TeamSplit& split : lower.take_sent<TeamSplit>())
    higher.part.on(higher.state, kLower, split, higher.branches);

  EXPECT_EQ(name_of(*lower.state.mission), "M/1");
  EXPECT_EQ(name_of(*higher.state.mission), "M/2");
  EXPECT_FALSE(higher.part.waits_for_split());
  for (const auto& [number, task] : lower.state.knowledge.tasks) {
    ASSERT_TRUE(task.branch);
    EXPECT_EQ(task.branch, higher.state.knowledge.tasks.at(number).branch);
  }
  EXPECT_EQ(lower.branches.open_tasks(lower.state).size() +
                higher.branches.open_tasks(higher.state).size(),
            4u);
}

TEST(TeamEncounters, ASplitThatWasNotAskedForChangesNothing) {
  Leader lower(kLower, 500);
  lower.part.on(lower.state, kHigher, {{"M", kLower}, {kLower, kHigher, 2}, 0, 1, {}},
                lower.branches);
  EXPECT_EQ(name_of(*lower.state.mission), "M");
  EXPECT_EQ(lower.state.outbox.take().events.front().kind, EventKind::kTeamAnswerRefused);
}

TEST(TeamBranches, TasksOfALostBranchAreTakenBackByTheLowestOnly) {
  for (const EntityId own : {kLower, kHigher}) {
    Leader leader(own, 500);
    leader.state.mission->branch = own;
    auto tasks = tasks_in_a_row(3);
    tasks[0].branch = kLower;
    tasks[1].branch = kHigher;
    tasks[2].branch = EntityId{3};
    leader.state.knowledge.submit(tasks);
    leader.branches.step(leader.state);
    leader.at(kNow + leader.state.lost + 1);
    const EntityId other = own == kLower ? kHigher : kLower;
    leader.branches.received(other, leader.state.now);
    leader.branches.step(leader.state);
    EXPECT_EQ(leader.branches.open_tasks(leader.state).size(),
              own == kLower ? 3u : 2u)  // task 4 belongs to no branch
        << own.value;
  }
}

}  // namespace
}  // namespace skein::reasoning::encounters_test
