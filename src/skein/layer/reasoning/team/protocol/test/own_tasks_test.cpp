// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/own_tasks.h"

#include <gtest/gtest.h>

#include "skein/layer/reasoning/team/protocol/duplicates.h"
#include "skein/layer/reasoning/team/protocol/test/lone_member.h"

namespace skein::reasoning::own_tasks_test {
namespace {

constexpr EntityId kLeader{1}, kOther{2}, kSelf{3}, kIntruder{4};
using Tasks = std::vector<std::uint32_t>;

TEST(OwnTasks, WhoIsNotAbleExecutesNothing) {
  OwnTasks own;
  EXPECT_TRUE(own.execute({1, 2}));
  EXPECT_FALSE(own.execute({1, 2})) << "the same";
  own.set_resources({.able = false});
  own.execute({3});
  EXPECT_EQ(own.executing(), Tasks{});
}

TEST(OwnTasks, SaysWhatIsDoneUntilItIsKnown) {
  OwnTasks own;
  TeamKnowledge knowledge;
  knowledge.submit(tasks_in_a_row(2));
  own.execute({2});
  own.set_progress(2, 0.5);
  own.set_progress(1, 1);
  ASSERT_EQ(own.progress(knowledge).size(), 2u);
  knowledge.finish(1);
  ASSERT_EQ(own.progress(knowledge).size(), 1u);
  EXPECT_EQ(own.progress(knowledge).front().task, 2u);
}

TEST(OwnTasks, RefusesWhatItLeavesToOthersUntilTheyDoNotFlyIt) {
  OwnTasks own;
  own.set_resources({.refused = {7}});
  own.yield(1, kOther);
  own.renew_refusals([](std::uint32_t, EntityId) { return true; });
  EXPECT_EQ(own.resources().refused, (Tasks{7, 1}));
  own.renew_refusals([](std::uint32_t, EntityId) { return false; });
  EXPECT_EQ(own.resources().refused, Tasks{7});
  EXPECT_FALSE(own.has_yielded(1));
}

// A follower that executes task 1, and another one that says that it does too.
struct Twice : LoneMember {
  DuplicateTasks part;

  Twice() : LoneMember(kSelf) {
    state.knowledge.submit(tasks_in_a_row(2));
    state.role = TeamRole::kFollowing;
    state.leader = {kLeader, 0, 0, 0};
    state.set_status(TeamReason::kFollowing);
    receive_query(kLeader);
    state.execute({1});
  }
  void hears_of_other(EntityId leader, std::uint32_t query) {
    TeamInform inform = receive_inform(kOther, leader);
    inform.query = query;
    inform.tasks = {{1, 0.3}};
    part.on(state, kOther, inform);
  }
};

TEST(DuplicateTasks, OfTwoTeamsTheLowerLeadersMemberFliesOn) {
  Twice member;
  member.hears_of_other(kIntruder, 1);
  EXPECT_EQ(member.state.own.executing(), Tasks{1});
  Twice yields;
  yields.state.leader.id = kIntruder;
  yields.state.set_status(TeamReason::kFollowing);
  yields.hears_of_other(kLeader, 1);
  EXPECT_EQ(yields.state.own.executing(), Tasks{});
  EXPECT_TRUE(yields.state.own.has_yielded(1));
}

TEST(DuplicateTasks, OfOneTeamWhoReceivesTheLeaderFliesOn) {
  Twice member;
  member.at(1);
  member.hears_of_other(kLeader, 9);
  EXPECT_EQ(member.state.own.executing(), Tasks{1}) << "it receives the leader itself";
  member.at(4);
  member.hears_of_other(kLeader, 9);
  EXPECT_EQ(member.state.own.executing(), Tasks{});
}

}  // namespace
}  // namespace skein::reasoning::own_tasks_test
