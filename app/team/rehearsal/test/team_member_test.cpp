// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/team_member.h"

#include <gtest/gtest.h>

#include "app/team/rehearsal/test/small_team.h"

namespace skein::rehearsal::team_member_test {
namespace {

using Masters = std::map<std::uint32_t, std::uint32_t>;
using Executors = std::map<std::uint32_t, int>;

SmallTeam team_of(const std::vector<std::uint32_t>& ids, std::uint32_t tasks,
                  const reasoning::TeamConfig& config = {}) {
  SmallTeam team;
  for (const std::uint32_t id : ids) team.add(id, config);
  team.submit(tasks);
  team.run(30);
  return team;
}

TEST(TeamMember, TheLowestLeadsAndEachHasATask) {
  SmallTeam team = team_of({7, 3, 5}, 3);
  EXPECT_EQ(team.masters(), (Masters{{3, 3}, {5, 3}, {7, 3}}));
  EXPECT_EQ(team.executors(), (Executors{{1, 1}, {2, 1}, {3, 1}}));
  EXPECT_EQ(team.at(7).status().reason, TeamReason::kSelected);
  EXPECT_EQ(team.at(7).status().members, (std::vector<EntityId>{{3}, {5}, {7}}));
  EXPECT_TRUE(team.at(3).orders_acknowledged());
  EXPECT_EQ(team.at(7).lost_after(), 4);
  EXPECT_LT(team.at(3).round_trip(), 0.3);
}

TEST(TeamMember, AnyOtherRuleMaySelect) {
  reasoning::TeamConfig config;
  config.select = [](std::span<const EntityId> ids) { return ids.back(); };
  SmallTeam team = team_of({7, 3, 5}, 3, config);
  EXPECT_EQ(team.masters(), (Masters{{3, 7}, {5, 7}, {7, 7}}));
  team.crash(7);
  team.run(10);
  EXPECT_EQ(team.masters(), (Masters{{3, 5}, {5, 5}}));
}

TEST(TeamMember, ClocksThatAreOffDoNotMatter) {
  SmallTeam team;
  for (const std::uint32_t id : {2U, 4U, 6U}) team.add(id);
  team.clock_offset = {{{2}, 0}, {{4}, 7.3}, {{6}, 1000}};
  team.submit(3);
  team.run(30);
  EXPECT_EQ(team.masters(), (Masters{{2, 2}, {4, 2}, {6, 2}}));
  team.crash(2);
  team.run(10);
  EXPECT_EQ(team.masters(), (Masters{{4, 4}, {6, 4}}));
}

TEST(TeamMember, AMasterThatLeavesHandsOverWithoutAGap) {
  SmallTeam team = team_of({2, 4, 6}, 3);
  team.at(2).leave();
  const auto before = team.executors();
  bool led_by_both = false;
  for (int k = 0; k < 30; ++k) {
    team.run(0.1);
    int leading = 0;
    for (const auto& [id, member] : team.members) leading += member.leads() ? 1 : 0;
    EXPECT_GE(leading, 1) << "at no time nobody";
    led_by_both = led_by_both || leading > 1;
    EXPECT_EQ(team.executors(), before) << "all fly on";
  }
  EXPECT_EQ(team.masters(), (Masters{{2, 4}, {4, 4}, {6, 4}}));
  EXPECT_EQ(team.at(4).status().reason, TeamReason::kHandover);
  EXPECT_EQ(team.count(EventKind::kTeamHandover), 1);
  EXPECT_EQ(team.count(EventKind::kTeamMerged), 0);
  // It is not selected again while others are there.
  team.crash(4);
  team.run(12);
  EXPECT_EQ(team.masters(), (Masters{{2, 6}, {6, 6}}));
}

TEST(TeamMember, AGroundStationLeadsAndFliesNothing) {
  SmallTeam team;
  reasoning::TeamConfig config;
  config.structure = reasoning::TeamStructure::kFixedMaster;
  config.fixed_leader = EntityId{9};
  for (const std::uint32_t id : {2U, 4U, 9U}) team.add(id, config);
  TeamResources station;
  station.able = false;
  team.at(9).set_resources(station);
  team.submit(2);
  team.run(30);
  EXPECT_EQ(team.masters(), (Masters{{2, 9}, {4, 9}, {9, 9}}));
  EXPECT_EQ(team.at(9).status().reason, TeamReason::kFixed);
  EXPECT_TRUE(team.at(9).tasks().empty());
  EXPECT_EQ(team.executors(), (Executors{{1, 1}, {2, 1}}));
  // Without it nobody leads, and all fly on.
  team.crash(9);
  team.run(20);
  EXPECT_EQ(team.masters(), (Masters{{2, 0}, {4, 0}}));
  EXPECT_EQ(team.executors(), (Executors{{1, 1}, {2, 1}}));
}

TEST(TeamMember, AStationThatIsOneMoreMemberMayLead) {
  SmallTeam team;
  for (const std::uint32_t id : {1U, 4U, 6U}) team.add(id);
  TeamResources station;
  station.able = false;
  team.at(1).set_resources(station);
  team.submit(2);
  team.run(30);
  EXPECT_EQ(team.masters(), (Masters{{1, 1}, {4, 1}, {6, 1}}));
  EXPECT_TRUE(team.at(1).tasks().empty());
  EXPECT_EQ(team.executors(), (Executors{{1, 1}, {2, 1}}));
}

TEST(TeamMember, WithoutStructureEachIsAlone) {
  reasoning::TeamConfig config;
  config.structure = reasoning::TeamStructure::kNone;
  SmallTeam team = team_of({2, 4}, 3, config);
  EXPECT_EQ(team.masters(), (Masters{{2, 2}, {4, 4}}));
  EXPECT_EQ(team.at(2).status().members, std::vector<EntityId>{{2}});
  EXPECT_FALSE(team.at(2).tasks().empty());
}

TEST(TeamMember, InAnAuctionNobodyLeadsAndNoTaskIsFlownTwice) {
  reasoning::TeamConfig config;
  config.structure = reasoning::TeamStructure::kAuction;
  SmallTeam team = team_of({2, 4, 6}, 3, config);
  EXPECT_EQ(team.executors(), (Executors{{1, 1}, {2, 1}, {3, 1}}));
  const auto lost = team.at(4).tasks();
  team.crash(4);
  team.run(8);
  EXPECT_EQ(team.executors().size(), 2u) << "one task more than members";
  team.add(8, config).submit("M", SmallTeam::tasks(3), Time::from_seconds(team.now));
  team.run(8);
  EXPECT_EQ(team.executors(), (Executors{{1, 1}, {2, 1}, {3, 1}}));
}

TEST(TeamMember, ATaskOfTheLostIsFlownByWhoIsIdle) {
  SmallTeam team = team_of({2, 4, 6}, 2);
  const std::uint32_t busy = team.at(4).tasks().empty() ? 6 : 4;
  team.crash(busy);
  team.run(4 + 5);
  EXPECT_EQ(team.executors(), (Executors{{1, 1}, {2, 1}}));
  EXPECT_EQ(team.count(EventKind::kTeamFollowerLost), 1);
}

TEST(TeamMember, WhoIsNotAbleAnyMoreGivesItsTaskUp) {
  SmallTeam team = team_of({2, 4, 6}, 2);
  const std::uint32_t busy = team.at(4).tasks().empty() ? 6 : 4;
  TeamResources resources;
  resources.able = false;
  team.at(busy).set_resources(resources);
  team.run(5);
  EXPECT_TRUE(team.at(busy).tasks().empty());
  EXPECT_EQ(team.executors(), (Executors{{1, 1}, {2, 1}}));
}

TEST(TeamMember, WhoIsDoneGetsTheNextTask) {
  SmallTeam team = team_of({2, 4}, 4);
  ASSERT_EQ(team.at(4).tasks().size(), 1u);
  const std::uint32_t first = team.at(4).tasks().front();
  team.at(4).set_progress(first, 1);
  team.run(5);
  ASSERT_EQ(team.at(4).tasks().size(), 1u);
  EXPECT_NE(team.at(4).tasks().front(), first);
  EXPECT_EQ(team.executors().count(first), 0u);
  EXPECT_EQ(team.executors().size(), 2u);
  // Others know: it is not flown again by whoever takes over.
  team.crash(2);
  team.run(10);
  EXPECT_EQ(team.executors().count(first), 0u);
}

TEST(TeamMember, TasksCanBeAddedByTheMaster) {
  SmallTeam team = team_of({2, 4}, 1);
  const auto more = SmallTeam::tasks(2);
  EXPECT_FALSE(team.at(4).submit("M", more, Time::from_seconds(team.now)));
  EXPECT_FALSE(team.at(2).submit("N", more, Time::from_seconds(team.now)));
  EXPECT_TRUE(team.at(2).submit("M", more, Time::from_seconds(team.now)));
  team.run(10);
  EXPECT_EQ(team.executors(), (Executors{{1, 1}, {2, 1}}));
  EXPECT_EQ(team.at(4).knowledge().tasks.size(), 2u);
}

TEST(TeamMember, ANewcomerChoosesTheSmallestTeamAndNeverLeadsAtOnce) {
  SmallTeam team = team_of({5, 7, 9}, 4);
  team.network.partition({{{5}, {7}}, {{9}}});
  team.run(30);
  team.add(1);
  team.run(12);
  EXPECT_EQ(team.masters(), (Masters{{1, 9}, {5, 5}, {7, 5}, {9, 9}}));
  EXPECT_EQ(team.at(1).status().reason, TeamReason::kJoined);
  EXPECT_EQ(team.at(1).tasks().size(), 1u);
}

TEST(TeamMember, ANewcomerThatNobodyNeedsWaits) {
  reasoning::TeamConfig config;
  config.admit = [](const TeamResources&, std::span<const TeamTask>,
                    std::span<const reasoning::TeamWorker>) { return false; };
  SmallTeam team = team_of({5, 7}, 2, config);
  team.add(9);
  team.run(30);
  EXPECT_EQ(team.masters(), (Masters{{5, 5}, {7, 5}, {9, 0}}));
  EXPECT_GE(team.count(EventKind::kTeamRejected), 2);
}

// Two teams that meet twice, as in section 10: merge, then split.
struct Split {
  SmallTeam team = team_of({2, 4, 6}, 6);
  Split() {
    for (int k = 0; k < 2; ++k) {
      team.network.partition({{{2}, {4}}, {{6}}});
      team.run(30);
      team.network.heal();
      team.run(12);
      if (k == 0) {
        EXPECT_EQ(team.masters(), (Masters{{2, 2}, {4, 2}, {6, 2}}));
        EXPECT_EQ(team.at(6).status().reason, TeamReason::kMerged);
      }
    }
  }
};

TEST(TeamMember, TwoMastersThatMeetTwiceSplitTheMission) {
  Split split;
  SmallTeam& team = split.team;
  EXPECT_EQ(team.masters(), (Masters{{2, 2}, {4, 2}, {6, 6}}));
  EXPECT_EQ(name_of(*team.at(4).status().mission), "M/2");
  EXPECT_EQ(name_of(*team.at(6).status().mission), "M/6");
  int of_second = 0;
  for (const auto& [number, task] : team.at(6).knowledge().tasks) {
    EXPECT_EQ(task, team.at(2).knowledge().tasks.at(number)) << "both know the same";
    of_second += task.branch == EntityId{6} ? 1 : 0;
  }
  EXPECT_EQ(of_second, 2);
  // They do not fight again.
  team.run(60);
  EXPECT_EQ(team.masters(), (Masters{{2, 2}, {4, 2}, {6, 6}}));
  for (const auto& [task, count] : team.executors()) EXPECT_EQ(count, 1) << task;
}

TEST(TeamMember, TasksOfALostBranchAreTakenBackAndGivenBack) {
  Split split;
  SmallTeam& team = split.team;
  // Two members have more than their share of tasks done.
  std::set<std::uint32_t> theirs;
  for (const auto& [number, task] : team.at(2).knowledge().tasks)
    if (task.branch == EntityId{6})
      theirs.insert(number);
    else if (team.at(2).leads())
      for (const std::uint32_t id : {2U, 4U}) team.at(id).set_progress(number, 1);
  team.run(20);
  EXPECT_TRUE(team.at(4).tasks().empty());
  team.network.partition({{{2}, {4}}, {{6}}});
  team.run(10);
  EXPECT_EQ(team.count(EventKind::kTeamTookBack), 1 + 1)
      << "each takes those of the other";
  for (const std::uint32_t id : {2U, 4U}) {
    ASSERT_EQ(team.at(id).tasks().size(), 1u);
    EXPECT_TRUE(theirs.contains(team.at(id).tasks().front()));
  }
  team.network.heal();
  team.run(4 + 3);
  EXPECT_EQ(team.count(EventKind::kTeamGaveBack), 2);
  EXPECT_TRUE(team.at(2).tasks().empty());
  EXPECT_TRUE(team.at(4).tasks().empty());
  EXPECT_EQ(team.at(6).tasks().size(), 1u);
}

TEST(TeamMember, AShortLossOfTheMasterDoesNotCountAsMeeting) {
  SmallTeam team = team_of({2, 4, 6}, 3);
  for (int k = 0; k < 3; ++k) {
    team.network.partition({{{2}, {4}}, {{6}}});
    team.run(8);  // it has just begun to lead
    team.network.heal();
    team.run(15);
    EXPECT_EQ(team.masters(), (Masters{{2, 2}, {4, 2}, {6, 2}})) << k;
  }
  EXPECT_EQ(team.count(EventKind::kTeamSplit), 0);
}

// All in which 2 said in full that it follows 6 was lost; what it says in short is
// enough.
TEST(TeamMember, GoesWithAMasterThatGivesWayWhicheverMessageSaysSo) {
  SmallTeam team = team_of({2, 4, 6}, 3);
  const auto says = [&](std::uint32_t number, std::uint32_t master) {
    const reasoning::TeamReceived message{
        {2}, true, {TeamMessage::kVersion, number, TeamHere{EntityId{master}}}};
    team.now += 0.01;
    team.at(4).step(Time::from_seconds(team.now), {&message, 1});
    return team.at(4).status();
  };
  EXPECT_EQ(says(100, 2).master, EntityId{2}) << "it follows nobody";
  EXPECT_EQ(says(101, 4).master, EntityId{2}) << "nobody leads for that";
  const TeamStatus after = says(102, 6);
  EXPECT_EQ(after.master, EntityId{6});
  EXPECT_EQ(after.reason, TeamReason::kMerged);
}

// An order of 2 with a number of its own.
reasoning::TeamStep order(SmallTeam& team, std::uint32_t to, std::uint32_t number,
                          std::vector<TeamTask> tasks) {
  const reasoning::TeamReceived message{
      {2},
      false,
      {TeamMessage::kVersion, 60, TeamAssign{{"M"}, number, std::move(tasks)}}};
  team.now += 0.01;
  return team.at(to).step(Time::from_seconds(team.now), {&message, 1});
}

TEST(TeamMember, DoesNotFlyAgainWhatItHasDone) {
  SmallTeam team = team_of({2, 4}, 2);
  ASSERT_EQ(team.at(4).tasks().size(), 1u);
  const TeamTask done = team.at(4).knowledge().tasks.at(team.at(4).tasks().front());
  team.at(4).set_progress(done.number, 1);
  const reasoning::TeamStep step = order(team, 4, 60, {done});
  EXPECT_TRUE(team.at(4).tasks().empty());
  EXPECT_TRUE(std::ranges::any_of(step.send, [](const reasoning::TeamOutgoing& one) {
    return std::holds_alternative<TeamAssignAck>(one.message.content);
  }));
}

TEST(TeamMember, ObeysAMasterThatCountsItsOrdersAnew) {
  SmallTeam team = team_of({2, 4, 6}, 3);
  order(team, 6, 999, {});
  ASSERT_TRUE(team.at(6).tasks().empty());
  team.network.partition({{{2}}, {{4}, {6}}});
  team.run(12);
  team.network.heal();
  team.run(20);
  EXPECT_EQ(team.masters(), (Masters{{2, 2}, {4, 2}, {6, 2}}));
  EXPECT_EQ(team.executors(), (Executors{{1, 1}, {2, 1}, {3, 1}}));
  EXPECT_TRUE(team.at(2).orders_acknowledged());
}

TEST(TeamMember, TellsANewMasterWhatOnlyTheOldOneKnew) {
  SmallTeam team = team_of({2, 4, 6}, 2);
  team.network.partition({{{2}}, {{4}, {6}}});
  team.run(30);
  auto more = SmallTeam::tasks(3);
  more.erase(more.begin(), more.begin() + 2);
  ASSERT_TRUE(team.at(4).submit("M", more, Time::from_seconds(team.now)));
  team.run(10);
  team.crash(4);
  team.network.heal();
  team.run(20);
  EXPECT_EQ(team.masters(), (Masters{{2, 2}, {6, 2}}));
  EXPECT_TRUE(team.at(2).knowledge().tasks.contains(3));
}

TEST(TeamMember, AStationFollowsTheBranchThatItReceives) {
  SmallTeam team;
  reasoning::TeamConfig config;
  config.operators = {{9}};
  for (const std::uint32_t id : {2U, 4U, 6U, 9U}) team.add(id, config);
  TeamResources station;
  station.able = false;
  team.at(9).set_resources(station);
  team.submit(6);
  team.run(40);
  for (int k = 0; k < 2; ++k) {
    team.network.partition({{{2}, {4}, {9}}, {{6}}});
    team.run(30);
    team.network.heal();
    team.run(20);
  }
  ASSERT_EQ(team.masters(), (Masters{{2, 2}, {4, 2}, {6, 6}, {9, 2}}));
  team.network.partition({{{2}, {4}}, {{6}, {9}}});
  team.run(30);
  EXPECT_EQ(team.masters(), (Masters{{2, 2}, {4, 2}, {6, 6}, {9, 6}}));
  team.network.partition({{{2}, {4}, {9}}, {{6}}});
  team.run(30);
  EXPECT_EQ(team.masters().at(9), 2u);
}

}  // namespace
}  // namespace skein::rehearsal::team_member_test
