// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/election.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "skein/layer/reasoning/team/protocol/test/lone_member.h"

namespace skein::reasoning::election_test {
namespace {

constexpr EntityId kLost{1}, kA{2}, kB{3}, kC{4};
constexpr double kStep = 0.1;  // [s]

// A member whose leader was last known to lead at 0.
LoneMember without_leader(EntityId self, TeamConfig config = {}) {
  LoneMember member(self, std::move(config));
  member.state.leader.id = kLost;
  return member;
}

// What comes of `duration` [s] of an election in which the others are received each
// second; ends with the first transition.
TeamTransition elect(TeamElection& election, LoneMember& member, double duration,
                     const std::vector<EntityId>& others) {
  const double begin = member.state.now;
  for (int k = 1; k * kStep <= duration; ++k) {
    member.at(begin + k * kStep);
    if (k % 10 == 0)
      for (const EntityId id : others) member.receive_inform(id, kLost);
    const TeamTransition now = election.step(member.state, true);
    if (!is_none(now)) return now;
  }
  return {};
}

TEST(TeamElection, WaitsUntilTheLeaderIsLost) {
  TeamElection election;
  LoneMember member = without_leader(kA);
  EXPECT_TRUE(is_none(elect(election, member, member.state.lost, {kB})));
  EXPECT_FALSE(election.chosen());
}

TEST(TeamElection, TheLowestThatIsReceivedLeads) {
  TeamElection election;
  LoneMember member = without_leader(kA);
  const auto result = elect(election, member, 60, {kB, kC});
  const auto* lead = std::get_if<LeadTeam>(&result);
  ASSERT_TRUE(lead);
  EXPECT_EQ(lead->reason, TeamReason::kSelected);
  EXPECT_EQ(lead->predecessor, kLost);
  EXPECT_EQ(election.chosen(), kA);
}

TEST(TeamElection, NobodyIsLeaderBeforeItHasSaidSo) {
  TeamElection election;
  LoneMember member = without_leader(kB);
  for (int k = 1; k < 400; ++k) {
    member.at(k * kStep);
    if (k % 10 == 0) member.receive_inform(kA, kLost);
    const auto result = election.step(member.state, true);
    EXPECT_FALSE(std::holds_alternative<FollowOther>(result));
    if (!is_none(result)) {
      EXPECT_NE(election.chosen(), kA);
      break;
    }
  }
}

TEST(TeamElection, PassesOverWhoWasChosenAndDoesNotLead) {
  TeamElection election;
  LoneMember member = without_leader(kB);
  const auto result = elect(election, member, 120, {kA});
  EXPECT_TRUE(std::holds_alternative<LeadTeam>(result));
  EXPECT_GT(member.state.now, member.state.lost + member.state.exchange_time());
}

TEST(TeamElection, WhoLeavesOrFollowsAnotherOneIsNotChosen) {
  TeamElection election;
  LoneMember member = without_leader(kC);
  for (int k = 1; k <= 300; ++k) {
    member.at(k * kStep);
    if (k % 10 == 0) {
      member.receive_inform(kA, kLost, true);
      member.receive_inform(kB, EntityId{9});
    }
    const auto result = election.step(member.state, true);
    EXPECT_NE(election.chosen(), kA);
    EXPECT_NE(election.chosen(), kB);
    if (!is_none(result)) return;
  }
  FAIL() << "the only one that may lead does not";
}

TEST(TeamElection, AStationLeadsOnlyWhenItsTeamIsGone) {
  TeamConfig config;
  config.operators = {kA};
  LoneMember station = without_leader(kA, config);
  TeamElection election;
  for (int k = 1; k <= 600; ++k) {
    station.at(k * kStep);
    EXPECT_TRUE(is_none(election.step(station.state, false)));
  }
  const double patience = station.state.exchange_time();
  EXPECT_TRUE(is_none(elect(election, station, patience, {kB}))) << "that one may lead";
  EXPECT_FALSE(is_none(elect(election, station, 60, {})));
}

TEST(TeamElection, OfAFixedLeaderThereIsNone) {
  TeamConfig config;
  config.structure = TeamStructure::kFixedMaster;
  config.fixed_leader = kC;
  TeamElection election;
  LoneMember other = without_leader(kA, config);
  EXPECT_TRUE(is_none(elect(election, other, 200, {kB})));
  EXPECT_TRUE(is_none(TeamElection::first(other.state)));
  const LoneMember fixed(kC, config);
  EXPECT_FALSE(is_none(TeamElection::first(fixed.state)));
}

// Each receives all others and does as they do: one leads, before anybody else does.
TEST(TeamElection, OneAloneBeginsToLead) {
  EXPECT_TRUE(rc::check("one leads", [] {
    const auto count = static_cast<std::uint32_t>(*rc::gen::inRange(1, 8));
    std::vector<LoneMember> members;
    std::vector<bool> leaving;
    for (std::uint32_t k = 0; k < count; ++k) {
      members.push_back(without_leader({10 + k}));
      leaving.push_back(k + 1 < count && *rc::gen::arbitrary<bool>());
      members.back().state.leaving = leaving.back();
    }
    std::vector<TeamElection> elections(count);
    std::vector<EntityId> leaders;
    for (int k = 1; k <= 300 && leaders.empty(); ++k)
      for (std::uint32_t own = 0; own < count; ++own) {
        LoneMember& member = members[own];
        member.at(k * kStep);
        for (std::uint32_t other = 0; k % 10 == 0 && other < count; ++other)
          if (other != own) member.receive_inform({10 + other}, kLost, leaving[other]);
        if (!is_none(elections[own].step(member.state, true)))
          leaders.push_back(member.state.self);
      }
    RC_ASSERT(leaders.size() == 1u);
  }));
}

}  // namespace
}  // namespace skein::reasoning::election_test
