// SPDX-License-Identifier: Apache-2.0
// Allocations that wait for an operator, over a radio that loses messages.
#include <gtest/gtest.h>

#include <utility>

#include "skein/layer/reasoning/team/onboard/test/air_team.h"

namespace skein::reasoning::team_approval_test {
namespace {

constexpr auto kApprove = AllocationAction::kApprove;
constexpr auto kReject = AllocationAction::kReject;

std::vector<WantedTask> places(int count) {
  std::vector<WantedTask> all;
  for (int k = 0; k < count; ++k)
    all.push_back({Measure{{300.0 * k, 500}, 30}, 0, false});
  return all;
}

AirTeam asked(std::uint32_t aircraft, double loss,
              TeamStructure structure = TeamStructure::kMaster) {
  AirTeam team(structure, true);
  team.loss = loss;
  team.task_time = 1e6;
  for (std::uint32_t id = 1; id <= aircraft; ++id) team.add(id, {0, 100.0 * id});
  return team;
}

using Flown = std::multiset<std::uint32_t>;

TEST(TeamApproval, NothingIsFlownUntilTheOperatorApproves) {
  AirTeam team = asked(3, 0.2);
  team.desk->hand_in("M", places(3), Time());
  team.run(60);
  EXPECT_EQ(team.masters(), std::set<std::uint32_t>{1}) << team.story();
  EXPECT_EQ(team.flown(), Flown{}) << team.story();
  EXPECT_GE(team.count(EventKind::kAllocationProposed), 1) << team.story();
  EXPECT_GE(team.count(EventKind::kTeamProposed), 1) << team.story();
  ASSERT_EQ(team.decide(kApprove), "");
  team.run(20);
  EXPECT_EQ(team.flown(), (Flown{1, 2, 3})) << team.story();
  ASSERT_FALSE(team.allocations.empty());
  const TeamAllocationReport& last = team.allocations.back();
  EXPECT_EQ(last.state, AllocationState::kApproved);
  EXPECT_EQ(last.proposer, EntityId{1});
  EXPECT_EQ(last.shares.size(), 3u);
  ASSERT_TRUE(last.value && last.bound && last.gap);
  EXPECT_GE(*last.bound, *last.value);
  EXPECT_NEAR(*last.gap, 0, 1e-9) << "proven for so few";
  EXPECT_GE(team.count(EventKind::kAllocationOver), 1) << team.story();
}

TEST(TeamApproval, WhatIsRejectedIsNotProposedAgainUntilSomethingElseIsWanted) {
  AirTeam team = asked(3, 0.2);
  team.desk->hand_in("M", places(2), Time());
  team.run(60);
  const int proposed = team.count(EventKind::kAllocationProposed);
  ASSERT_EQ(team.decide(kReject), "");
  team.run(120);
  EXPECT_EQ(team.flown(), Flown{}) << team.story();
  EXPECT_EQ(team.count(EventKind::kAllocationProposed), proposed) << team.story();
  EXPECT_EQ(team.decide(kApprove), "none waits for approval.");
  team.desk->hand_in("M", places(1), Time::from_seconds(team.now));
  team.run(30);
  EXPECT_EQ(team.count(EventKind::kAllocationProposed), proposed + 1) << team.story();
  ASSERT_EQ(team.decide(kApprove), "");
  team.run(20);
  EXPECT_EQ(team.flown(), (Flown{1, 2, 3})) << team.story();
}

TEST(TeamApproval, ALostMembersTaskIsTakenOverUnaskedButNewOnesWait) {
  AirTeam team = asked(4, 0.2);
  team.desk->hand_in("M", places(2), Time());
  team.run(60);
  ASSERT_EQ(team.decide(kApprove), "");
  team.run(20);
  ASSERT_EQ(team.flown(), (Flown{1, 2})) << team.story();
  EntityId busy;
  for (const auto& [id, one] : team.aircraft)
    if (one.team->task() && id != EntityId{1}) busy = id;
  team.aircraft.erase(busy);
  team.desk->hand_in("M", places(1), Time::from_seconds(team.now));
  team.run(40);
  EXPECT_EQ(team.flown(), (Flown{1, 2})) << team.story();
  EXPECT_EQ(std::ranges::count(team.allocations, AllocationState::kTakenOver,
                               &TeamAllocationReport::state),
            1);
  ASSERT_EQ(team.decide(kApprove), "") << team.story();
  team.run(20);
  EXPECT_EQ(team.flown(), (Flown{1, 2, 3})) << team.story();
}

TEST(TeamApproval, WhoTheOperatorTakesIsReplacedUnasked) {
  AirTeam team = asked(3, 0);
  team.desk->hand_in("M", places(1), Time());
  team.run(60);
  ASSERT_EQ(team.decide(kApprove), "");
  team.run(10);
  for (auto& [id, one] : team.aircraft)
    if (one.team->task()) one.work.free = false;
  team.run(20);
  EXPECT_EQ(team.flown(), Flown{1}) << team.story();
}

TEST(TeamApproval, AnotherMasterWorksOutItsOwnWithANumberOfItsOwn) {
  AirTeam team = asked(5, 0.2);
  team.desk->hand_in("M", places(2), Time());
  team.run(60);
  ASSERT_EQ(team.decide(kApprove), "");
  team.run(20);
  team.desk->hand_in("M", places(1), Time::from_seconds(team.now));
  team.run(20);
  const std::uint32_t old = team.allocations.back().number;
  ASSERT_EQ(team.state_of(old), "waits") << team.story();
  team.aircraft.erase(EntityId{1});
  team.run(60);
  EXPECT_EQ(team.masters(), std::set<std::uint32_t>{2}) << team.story();
  EXPECT_EQ(team.flown(), (Flown{1, 2})) << "what was approved is flown\n"
                                         << team.story();
  EXPECT_EQ(team.state_of(old), "withdrawn") << "the station says so";
  EXPECT_NE(team.decide(kApprove, old), "");
  ASSERT_EQ(team.decide(kApprove), "") << team.story();
  team.run(20);
  EXPECT_EQ(team.flown(), (Flown{1, 2, 3})) << team.story();
  EXPECT_GT(team.allocations.back().number, old);
}

TEST(TeamApproval, AProposalWhoseTaskIsDoneMeanwhileIsWorkedOutAnew) {
  AirTeam team = asked(3, 0);
  team.task_time = 60;
  team.desk->hand_in("M", places(2), Time());
  team.run(60);
  ASSERT_EQ(team.decide(kApprove), "");
  team.run(20);
  team.desk->hand_in("M", places(3), Time::from_seconds(team.now));
  team.run(15);
  const std::uint32_t old = team.allocations.back().number;
  ASSERT_EQ(team.state_of(old), "waits") << team.story();
  team.run(60);
  ASSERT_EQ(team.executed.size(), 2u) << team.story();
  EXPECT_EQ(team.state_of(old), "withdrawn") << team.story();
  EXPECT_NE(team.decide(kApprove, old).find("does not wait"), std::string::npos);
  ASSERT_EQ(team.decide(kApprove), "");
  team.run(200);
  EXPECT_GE(team.executed.size(), 4u) << team.story();
}

TEST(TeamApproval, DecisionsGetThroughABadRadio) {
  AirTeam team = asked(2, 0.6);
  team.desk->hand_in("M", places(2), Time());
  team.run(120);
  ASSERT_EQ(team.decide(kApprove), "") << team.story();
  team.run(60);
  EXPECT_EQ(team.flown(), (Flown{1, 2})) << team.story();
}

TEST(TeamApproval, AProposalWaitsWhileTheStationIsOutOfReachAndIsShownAgain) {
  AirTeam team = asked(2, 0);
  team.desk->hand_in("M", places(2), Time());
  team.run(60);
  team.station_receives = false;
  team.run(100);
  EXPECT_EQ(team.flown(), Flown{}) << team.story();
  team.station_receives = true;
  team.run(60);
  ASSERT_EQ(team.decide(kApprove), "") << team.story();
  team.run(20);
  EXPECT_EQ(team.flown(), (Flown{1, 2})) << team.story();
}

TEST(TeamApproval, AStationThatLeadsAsksItsOwnOperator) {
  AirTeam team = asked(2, 0.2, TeamStructure::kFixedMaster);
  team.desk->hand_in("M", places(2), Time());
  team.run(40);
  EXPECT_EQ(team.flown(), Flown{}) << team.story();
  ASSERT_EQ(team.decide(kApprove), "") << team.story();
  team.run(20);
  EXPECT_EQ(team.flown(), (Flown{1, 2})) << team.story();
}

TEST(TeamApproval, WhatCannotBeDecidedIsRefusedWithTheReason) {
  AirTeam team = asked(2, 0);
  EXPECT_EQ(team.decide(kApprove), "no mission of the team is going on.");
  team.desk->hand_in("M", places(1), Time());
  team.run(60);
  const std::uint32_t number = team.allocations.back().number;
  EXPECT_EQ(team.decide(kApprove, number + 7), std::to_string(number + 7) +
                                                   " does not wait, " +
                                                   std::to_string(number) + " does.");
  ASSERT_EQ(team.decide(kReject, number), "");
  EXPECT_EQ(team.decide(kReject, number), "") << "said twice is said once";
  EXPECT_NE(team.decide(kApprove, number).find("has been decided"), std::string::npos);
  AirTeam free(TeamStructure::kMaster);
  free.add(1, {0, 0});
  free.desk->hand_in("M", places(1), Time());
  free.run(30);
  EXPECT_EQ(free.decide(kApprove), "allocations of this team need no approval.");
}

TEST(TeamApproval, OnlyTheStationMayDecideAndOnlyAMasterPropose) {
  AirTeam team = asked(2, 0);
  team.desk->hand_in("M", places(2), Time());
  team.run(60);
  const std::uint32_t number = team.allocations.back().number;
  // Some come of the change of master.
  const int refused = team.count(EventKind::kTeamOrderRefused);
  const auto forge = [&](EntityId from, TeamContent content) {
    Message message;
    message.from = from;
    TeamMessage said;
    said.number = 1000 | (1U << 31);
    said.content = std::move(content);
    message.content = said;
    return message;
  };
  Message decision = forge(EntityId{2}, TeamDecision{number, TeamAnswer::kApprove});
  decision.to = EntityId{1};
  team.aircraft.at(EntityId{1}).inbox.push_back(decision);
  Message proposal =
      forge(EntityId{2},
            TeamProposal{{"M"}, number + 1, AllocationState::kWaits, {}, {}, {{{2}, 1}}});
  proposal.to = EntityId{0};
  team.to_station.push_back(proposal);
  team.run(20);
  EXPECT_EQ(team.flown(), Flown{}) << team.story();
  EXPECT_EQ(team.count(EventKind::kTeamAnswerRefused), 1) << team.story();
  EXPECT_EQ(team.count(EventKind::kTeamOrderRefused), refused + 1) << team.story();
  EXPECT_EQ(team.decide(kApprove, number), "") << "the other one still waits";
}

}  // namespace
}  // namespace skein::reasoning::team_approval_test
