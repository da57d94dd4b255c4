// SPDX-License-Identifier: Apache-2.0
// Messages that no honest member sends: they have a named outcome and change nothing.
#include <gtest/gtest.h>

#include "app/team/rehearsal/test/small_team.h"

namespace skein::rehearsal::hostile_test {
namespace {

// A follower, 4, of master 2, and one that forges messages to it.
class Hostile : public testing::Test {
 protected:
  Hostile() {
    for (const std::uint32_t id : {2U, 4U, 6U}) team_.add(id);
    team_.submit(3);
    team_.run(100);
    status_ = team_.at(4).status();
    tasks_ = team_.at(4).tasks();
  }

  // Kinds of events that a message causes.
  std::set<EventKind> outcome(std::uint32_t from, TeamContent content,
                              bool to_all = false, std::uint32_t number = 1,
                              std::uint32_t version = TeamMessage::kVersion) {
    const reasoning::TeamReceived message{
        {from}, to_all, {version, number, std::move(content)}};
    team_.now += 0.01;
    const reasoning::TeamStep step =
        team_.at(4).step(Time::from_seconds(team_.now), {&message, 1});
    EXPECT_EQ(team_.at(4).status(), status_);
    EXPECT_EQ(team_.at(4).tasks(), tasks_);
    std::set<EventKind> kinds;
    for (const Event& event : step.events) kinds.insert(event.kind.kind());
    return kinds;
  }
  using Kinds = std::set<EventKind>;

  SmallTeam team_;
  TeamStatus status_;
  std::vector<std::uint32_t> tasks_;
};

TEST_F(Hostile, OrdersOfWhoDoesNotLeadAreRefused) {
  const TeamAssign order{{"M"}, 99, SmallTeam::tasks(3)};
  EXPECT_EQ(outcome(6, order), Kinds{EventKind::kTeamOrderRefused});
  EXPECT_EQ(outcome(77, order), Kinds{EventKind::kTeamOrderRefused});
  EXPECT_EQ(outcome(2, TeamAssign{{"N"}, 99, {}}, false, 60),
            Kinds{EventKind::kTeamOrderRefused});
}

TEST_F(Hostile, OtherVersionsAndImpossibleValuesAreRefused) {
  EXPECT_EQ(outcome(2, TeamQuery{}, true, 9000, 7), Kinds{EventKind::kTeamOtherVersion});
  TeamInform bad;
  bad.resources.place = {1e300, 0, 0};
  EXPECT_EQ(outcome(2, bad, true, 9000), Kinds{EventKind::kTeamImplausible});
  EXPECT_EQ(outcome(6, TeamQuery{}, true, 4'000'000'000U),
            Kinds{EventKind::kTeamImplausible});
  EXPECT_EQ(outcome(4, TeamQuery{}, true), Kinds{EventKind::kTeamOwnId});
}

TEST_F(Hostile, TheSecondOfTwoWithOneIdIsRefused) {
  TeamQuery query;
  query.mission = TeamMission{"M"};
  query.successor = EntityId{4};
  EXPECT_EQ(outcome(2, query, true, 3), Kinds{EventKind::kTeamDuplicateId});
}

TEST_F(Hostile, AnswersThatNobodyAskedForAreRefused) {
  EXPECT_EQ(outcome(6, TeamSplit{{"M", EntityId{4}}, {{4}, {6}, 2}, 0, 1, {}}),
            Kinds{EventKind::kTeamAnswerRefused});
  EXPECT_EQ(outcome(6, TeamAccept{1, {"M"}, 0, 1}, false, 2), Kinds{});
  EXPECT_EQ(outcome(6, TeamMerge{{"M"}, {{4}, {6}, 1}, true, {{6}}}, false, 3), Kinds{});
  EXPECT_EQ(outcome(6, TeamState{1, 0, 1, {{6}}, {}, {}}, true, 5000),
            Kinds{EventKind::kTeamImplausible});
}

TEST_F(Hostile, AMasterIsNotMovedByWhoDoesNotLead) {
  reasoning::TeamMember& master = team_.at(2);
  const auto status = master.status();
  const auto known = master.knowledge().number();
  std::uint32_t number = 5;
  for (const TeamContent& content : std::initializer_list<TeamContent>{
           TeamState{1, 0, 1, {{6}}, {}, SmallTeam::tasks(9)},
           TeamMerge{{"M"}, {{2}, {6}, 2}, true, {{6}}},
           TeamMerge{{"M"}, {{2}, {6}, 1}, false, {{6}, {77}}}, TeamConfirm{4},
           TeamAssignAck{4000}, TeamSplit{{"M", EntityId{2}}, {{2}, {6}, 2}, 0, 1, {}}}) {
    const reasoning::TeamReceived message{
        {6}, false, {TeamMessage::kVersion, ++number, content}};
    team_.now += 0.01;
    const reasoning::TeamStep step =
        master.step(Time::from_seconds(team_.now), {&message, 1});
    EXPECT_EQ(master.status(), status) << kind_of(content);
    EXPECT_EQ(master.knowledge().number(), known) << kind_of(content);
    EXPECT_LE(step.events.size(), 1u) << kind_of(content);
  }
}

TEST_F(Hostile, IntrudersAreRefusedWhereTheTeamIsKnown) {
  SmallTeam team;
  reasoning::TeamConfig config;
  config.known = {{2}, {4}};
  for (const std::uint32_t id : {2U, 4U}) team.add(id, config);
  team.add(1);
  team.submit(3);
  team.run(30);
  EXPECT_EQ(team.masters().at(2), 2u);
  EXPECT_EQ(team.masters().at(4), 2u);
  EXPECT_GE(team.count(EventKind::kTeamUnknownSender), 2);
}

TEST_F(Hostile, AFloodIsReportedOnceInAWhile) {
  int reported = 0;
  for (std::uint32_t k = 0; k < 50; ++k)
    reported += static_cast<int>(outcome(2, TeamQuery{}, true, 1, 7).size());
  EXPECT_EQ(reported, 1);
}

// Two members with one id from the start: nothing stops, the others go on.
TEST(HostileTeam, GoesOnWithTwoMembersOfOneId) {
  SmallTeam team;
  for (const std::uint32_t id : {2U, 4U, 6U}) team.add(id);
  team.submit(3);
  team.run(30);
  reasoning::TeamMember twin({6}, {});
  twin.submit("M", SmallTeam::tasks(3), Time::from_seconds(team.now));
  for (int k = 0; k < 300; ++k) {
    std::vector<reasoning::TeamReceived> none;
    const reasoning::TeamStep step = twin.step(Time::from_seconds(team.now), none);
    team.network.send({6}, step.send, team.now);
    team.run(0.1);
  }
  EXPECT_EQ(team.masters().at(2), 2u);
  EXPECT_EQ(team.masters().at(4), 2u);
  EXPECT_GE(team.count(EventKind::kTeamDuplicateId), 1);
  EXPECT_EQ(team.executors(), (std::map<std::uint32_t, int>{{1, 1}, {2, 1}, {3, 1}}));
}

}  // namespace
}  // namespace skein::rehearsal::hostile_test
