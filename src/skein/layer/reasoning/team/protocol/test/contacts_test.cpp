// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/contacts.h"

#include <gtest/gtest.h>

#include <limits>

namespace skein::reasoning::contacts_test {
namespace {

constexpr EntityId kSelf{1}, kOther{2};
constexpr double kLost = 4;

TeamMessage inform(std::uint32_t number, float speed = 20) {
  TeamInform said;
  said.mission = TeamMission{"M"};
  said.resources.speed = speed;
  return {TeamMessage::kVersion, number, said};
}

struct Heard {
  TeamContacts contacts{kSelf, {}};
  double now = 0;
  TeamVerdict take(const TeamMessage& message, bool to_all = true) {
    return contacts.take(kOther, to_all, message, now, {kLost, kLost});
  }
};

TEST(TeamContacts, KnowsNewLateAndRepeatedMessages) {
  Heard heard;
  EXPECT_EQ(heard.take(inform(5)), TeamVerdict::kNew);
  EXPECT_EQ(heard.take(inform(8, 22)), TeamVerdict::kNew);
  EXPECT_EQ(heard.take(inform(7, 21)), TeamVerdict::kLate);
  EXPECT_EQ(heard.contacts.find(kOther)->inform.resources.speed, 22);
  EXPECT_EQ(heard.take(inform(7, 21)), TeamVerdict::kRepeated);
  EXPECT_EQ(heard.take(inform(8, 22)), TeamVerdict::kRepeated);
  // Numbers to one receiver count by themselves.
  const TeamMessage ack{TeamMessage::kVersion, 1, TeamAssignAck{3}};
  EXPECT_EQ(heard.take(ack, false), TeamVerdict::kNew);
  EXPECT_EQ(heard.take(ack, false), TeamVerdict::kRepeated);
}

TEST(TeamContacts, AShortSignRenewsTheInformItIsAbout) {
  Heard heard;
  const auto here = [](std::uint32_t number, std::uint32_t master) {
    TeamHere said;
    said.master = EntityId{master};
    said.query = 7;
    said.state_number = 9;
    return TeamMessage{TeamMessage::kVersion, number, said};
  };
  EXPECT_EQ(heard.take(here(1, 3)), TeamVerdict::kNew);
  EXPECT_LT(heard.contacts.find(kOther)->informed, 0) << "nothing is known of it";
  TeamMessage full = inform(2, 22);
  std::get<TeamInform>(full.content).master = EntityId{3};
  heard.take(full);
  heard.now = 3;
  heard.take(here(3, 3));
  const TeamContacts::Contact& known = *heard.contacts.find(kOther);
  EXPECT_EQ(known.informed, 3);
  EXPECT_EQ(known.inform.query, 7u);
  EXPECT_EQ(known.inform.state_number, 9u);
  EXPECT_EQ(known.inform.resources.speed, 22);
  // Of another master: the inform that said so was lost.
  heard.now = 4;
  heard.take(here(4, 5));
  EXPECT_EQ(known.informed, 3);
  EXPECT_EQ(known.heard, 4);
}

TEST(TeamContacts, RefusesWhatNoMemberSays) {
  Heard heard;
  TeamMessage other_version = inform(1);
  other_version.version = TeamMessage::kVersion + 1;
  EXPECT_EQ(heard.take(other_version), TeamVerdict::kOtherVersion);
  EXPECT_EQ(heard.contacts.take(kSelf, true, inform(1), 0, {kLost, kLost}),
            TeamVerdict::kOwnId);
  EXPECT_EQ(heard.take(inform(1, -1)), TeamVerdict::kImplausible);
  EXPECT_EQ(heard.take(inform(1, std::numeric_limits<float>::quiet_NaN())),
            TeamVerdict::kImplausible);
  TeamState state;
  state.part = 3;
  EXPECT_TRUE(is_implausible(state));
  EXPECT_TRUE(is_implausible(TeamAssign{{""}, 1, {}}));
  EXPECT_TRUE(is_implausible(TeamAssign{{"M"}, 1, std::vector<TeamTask>(1001)}));
  EXPECT_TRUE(is_implausible(TeamMerge{{"M"}, {{2}, {1}, 1}, false, {}}));
  EXPECT_FALSE(is_implausible(TeamQuery{}));
  // Nobody sends a million messages in a second.
  EXPECT_EQ(heard.take(inform(1)), TeamVerdict::kNew);
  heard.now = 1;
  EXPECT_EQ(heard.take(inform(1'000'000)), TeamVerdict::kImplausible);
  EXPECT_EQ(heard.take(inform(2)), TeamVerdict::kNew);
}

TEST(TeamContacts, RefusesWhoMayNotBeInTheTeam) {
  TeamContacts contacts(kSelf, {kSelf, EntityId{7}});
  EXPECT_EQ(contacts.take(kOther, true, inform(1), 0, {kLost, kLost}),
            TeamVerdict::kUnknown);
  EXPECT_EQ(contacts.take({7}, true, inform(1), 0, {kLost, kLost}), TeamVerdict::kNew);
}

TEST(TeamContacts, FindsTwoSendersWithOneId) {
  Heard heard;
  EXPECT_EQ(heard.take(inform(100)), TeamVerdict::kNew);
  EXPECT_EQ(heard.take(inform(100, 33)), TeamVerdict::kDuplicateId);
  EXPECT_EQ(heard.take(inform(3)), TeamVerdict::kDuplicateId);
  EXPECT_EQ(heard.contacts.find(kOther)->inform.resources.speed, 20);
  // The first is gone: the second was switched off and on, or has taken its place.
  heard.now = kLost + 0.1;
  EXPECT_EQ(heard.take(inform(4)), TeamVerdict::kNew);
  EXPECT_TRUE(heard.contacts.restarted());
  EXPECT_EQ(heard.take(inform(5)), TeamVerdict::kNew);
  EXPECT_FALSE(heard.contacts.restarted());
}

TEST(TeamContacts, TakesAbsenceForNoLoss) {
  Heard heard;
  for (std::uint32_t k = 1; k < 300; ++k) {
    heard.now += 1;
    EXPECT_EQ(heard.take(inform(k)), TeamVerdict::kNew);
  }
  EXPECT_EQ(heard.contacts.loss(), 0.05);
  heard.now += 60;
  EXPECT_EQ(heard.take(inform(400)), TeamVerdict::kNew);
  EXPECT_EQ(heard.contacts.loss(), 0.05);
}

TEST(TeamContacts, AQueryThatAStateHasOvertakenIsNotOutOfDate) {
  Heard heard;
  TeamQuery query;
  query.mission = TeamMission{"M"};
  const auto said = [](std::uint32_t number, TeamContent content) {
    return TeamMessage{TeamMessage::kVersion, number, std::move(content)};
  };
  heard.take(said(1, query));
  EXPECT_EQ(heard.take(said(3, TeamState{1, 0, 1, {}, {}, {}})), TeamVerdict::kNew);
  heard.now = 1;
  EXPECT_EQ(heard.take(said(2, query)), TeamVerdict::kNew);
  EXPECT_EQ(heard.contacts.find(kOther)->queried, 1);
  EXPECT_EQ(heard.contacts.find(kOther)->query_number, 2u);
  // What is said of now is: an inform outdates a query.
  EXPECT_EQ(heard.take(inform(6)), TeamVerdict::kNew);
  EXPECT_EQ(heard.take(said(5, query)), TeamVerdict::kLate);
  EXPECT_FALSE(heard.contacts.find(kOther)->leads);
}

TEST(TeamContacts, WhoWasSwitchedOffAndOnMayUseNumbersThatWereLostBefore) {
  Heard heard;
  heard.take(inform(10));
  heard.take(inform(30));
  const TeamMessage ack{TeamMessage::kVersion, 4, TeamAssignAck{3}};
  heard.take(ack, false);
  heard.now = kLost + 0.1;
  EXPECT_EQ(heard.take(inform(11, 33)), TeamVerdict::kNew);
  EXPECT_TRUE(heard.contacts.restarted());
  EXPECT_EQ(heard.contacts.find(kOther)->inform.resources.speed, 33);
  EXPECT_EQ(heard.take(inform(12)), TeamVerdict::kNew);
  EXPECT_EQ(heard.take(ack, false), TeamVerdict::kNew) << "what it says to one, too";
}

TEST(TeamContacts, WhatIsSaidToOneIsLateAlthoughNothingWasSaidToItForLong) {
  Heard heard;
  const auto ack = [](std::uint32_t number) {
    return TeamMessage{TeamMessage::kVersion, number, TeamAssignAck{number}};
  };
  heard.take(ack(8), false);
  heard.now = kLost;
  heard.take(inform(1));
  heard.now = kLost + 1;
  EXPECT_EQ(heard.take(ack(7), false), TeamVerdict::kNew);
  EXPECT_FALSE(heard.contacts.restarted());
}

}  // namespace
}  // namespace skein::reasoning::contacts_test
