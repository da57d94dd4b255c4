// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/following.h"

#include <gtest/gtest.h>

#include "skein/layer/reasoning/team/protocol/test/lone_member.h"

namespace skein::reasoning::following_test {
namespace {

constexpr EntityId kLeader{1}, kSelf{3}, kOther{2};

struct Follower : LoneMember {
  TeamFollowing part;

  Follower() : LoneMember(kSelf) {
    state.knowledge.submit(tasks_in_a_row(4));
    state.role = TeamRole::kFollowing;
    part.begin(state, kLeader, TeamReason::kFollowing);
  }
  bool is_ordered(EntityId from, std::uint32_t number, std::vector<std::uint32_t> tasks) {
    TeamAssign assign{*state.mission, number, {}};
    for (const std::uint32_t task : tasks)
      assign.tasks.push_back(state.knowledge.tasks.at(task));
    return part.on(state, from, assign);
  }
  TeamTransition is_asked(EntityId from, const TeamQuery& query) {
    receive(from, query);
    return part.on(state, from, query);
  }
};

using Tasks = std::vector<std::uint32_t>;

TEST(TeamFollowing, ObeysNobodyButItsLeader) {
  Follower follower;
  follower.receive_query(kOther);
  follower.is_ordered(kOther, 9, {1, 2});
  EXPECT_EQ(follower.state.own.executing(), Tasks{});
  const auto out = follower.state.outbox.take();
  ASSERT_FALSE(out.events.empty());
  EXPECT_EQ(out.events.back().kind, EventKind::kTeamOrderRefused);
  EXPECT_TRUE(out.send.empty()) << "nothing was acknowledged";
  follower.is_ordered(kLeader, 1, {2});
  EXPECT_EQ(follower.state.own.executing(), Tasks{2});
}

TEST(TeamFollowing, AnOlderOrderThatWasRepeatedChangesNothing) {
  Follower follower;
  follower.is_ordered(kLeader, 5, {2});
  follower.is_ordered(kLeader, 4, {1, 3});
  EXPECT_EQ(follower.state.own.executing(), Tasks{2});
}

TEST(TeamFollowing, WhatIsDoneOrLeftToOthersIsNotFlown) {
  Follower follower;
  follower.state.own.set_progress(1, 1);
  follower.state.knowledge.finish(2);
  follower.state.own.yield(3, kOther);
  EXPECT_TRUE(follower.is_ordered(kLeader, 1, {1, 2, 3, 4}));
  EXPECT_EQ(follower.state.own.executing(), Tasks{4});
  EXPECT_FALSE(follower.is_ordered(kLeader, 2, {4}));
}

TEST(TeamFollowing, NeverHasTwoLeaders) {
  Follower follower;
  for (int k = 1; k <= 100; ++k) {
    follower.at(k);
    EXPECT_TRUE(is_none(follower.is_asked(kLeader, follower.receive_query(kLeader))));
    TeamQuery rival = follower.receive_query(kOther, k);
    rival.predecessor = kLeader;
    EXPECT_TRUE(is_none(follower.is_asked(kOther, rival)))
        << "its own is received: another one does not count";
    EXPECT_EQ(follower.state.leader.id, kLeader);
    EXPECT_EQ(follower.state.status.master, kLeader);
  }
}

TEST(TeamFollowing, FollowsTheSuccessorThatItsLeaderAnnounced) {
  Follower follower;
  TeamQuery query = follower.receive_query(kLeader);
  query.successor = kOther;
  EXPECT_TRUE(is_none(follower.is_asked(kLeader, query)));
  const auto next = follower.is_asked(kOther, follower.receive_query(kOther, 0));
  const auto* other = std::get_if<FollowOther>(&next);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->leader, kOther);
  EXPECT_EQ(other->reason, TeamReason::kHandover);
  query.successor = kSelf;
  EXPECT_TRUE(std::holds_alternative<LeadTeam>(follower.is_asked(kLeader, query)));
}

TEST(TeamFollowing, FollowsWhoTookOverFromASilentLeader) {
  Follower follower;
  follower.at(3);
  TeamQuery query = follower.receive_query(kOther, 0.5);
  EXPECT_TRUE(is_none(follower.is_asked(kOther, query))) << "from whom?";
  query.predecessor = kLeader;
  EXPECT_FALSE(is_none(follower.is_asked(kOther, query)));
}

TEST(TeamFollowing, OthersThatReceiveTheLeaderAreEvidenceOfIt) {
  Follower follower;
  const double lost = follower.state.lost;
  follower.at(lost - 0.5);
  TeamInform inform = follower.receive_inform(kOther, kLeader);
  inform.query = 7;
  inform.held = 0.5;
  EXPECT_TRUE(is_none(follower.part.on(follower.state, kOther, inform)));
  EXPECT_DOUBLE_EQ(follower.state.leader.evidence, lost - 1);
  follower.at(lost + 0.1);
  EXPECT_FALSE(TeamFollowing::is_leader_lost(follower.state));
  follower.part.on(follower.state, kOther, inform);
  EXPECT_DOUBLE_EQ(follower.state.leader.evidence, lost - 1)
      << "the same query as before";
  follower.at(2 * lost);
  EXPECT_TRUE(TeamFollowing::is_leader_lost(follower.state));
}

TEST(TeamFollowing, AnOldOrderEndsWhenTheNewLeaderGivesNone) {
  Follower follower;
  follower.is_ordered(kLeader, 1, {1});
  follower.at(1);
  follower.part.begin(follower.state, kOther, TeamReason::kMerged);
  follower.at(1 + follower.state.exchange_time());
  follower.part.drop_old_order(follower.state);
  EXPECT_EQ(follower.state.own.executing(), Tasks{1});
  follower.at(1.1 + follower.state.exchange_time());
  follower.part.drop_old_order(follower.state);
  EXPECT_EQ(follower.state.own.executing(), Tasks{});
}

}  // namespace
}  // namespace skein::reasoning::following_test
