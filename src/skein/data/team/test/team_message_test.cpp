// SPDX-License-Identifier: Apache-2.0
#include "skein/data/team/team_message.h"

#include <gtest/gtest.h>

#include "skein/data/describe/json.h"
#include "skein/data/describe/wire.h"

namespace skein::team_message_test {
namespace {

TEST(TeamMessage, HasTheBytesOfTheTable) {
  EXPECT_EQ(air_bytes(TeamQuery{}), 25u);
  EXPECT_EQ(air_bytes(TeamInform{}), 70u);
  EXPECT_EQ(air_bytes(TeamPropose{}), 70u);
  EXPECT_EQ(air_bytes(TeamAccept{}), 25u);
  EXPECT_EQ(air_bytes(TeamReject{}), 13u);
  EXPECT_EQ(air_bytes(TeamConfirm{}), 17u);
  EXPECT_EQ(air_bytes(TeamDecline{}), 13u);
  EXPECT_EQ(air_bytes(TeamAssignAck{}), 17u);
  TeamAssign assign;
  EXPECT_EQ(air_bytes(assign), 21u);
  assign.tasks.resize(3);
  EXPECT_EQ(air_bytes(assign), 21u + 3 * 48);
  assign.tasks.back().after = {1};
  EXPECT_EQ(air_bytes(assign), 21u + 3 * 48 + 2);
  TeamInform inform;
  inform.resources.refused = {4, 5};
  EXPECT_EQ(air_bytes(inform), 74u);
  TeamState state;
  state.tasks.resize(2);
  state.tasks.front().after = {1, 3};
  EXPECT_EQ(air_bytes(state), 21u + 2 * 24 + 2 * 2);
}

TEST(TeamMessage, NamesBranchesAfterTheirFirstMaster) {
  EXPECT_EQ(name_of(TeamMission{"M"}), "M");
  EXPECT_EQ(name_of(TeamMission{"M", EntityId{11}}), "M/11");
}

TEST(TeamMessage, TravelsInTheWireForm) {
  TeamState state{
      7, 1, 2, {{3}, {5}}, {{{3}, {5}, 1}}, {{4, {1, 2}, true, false, EntityId{3}}}};
  state.tasks.front().after = {1, 3};
  state.tasks.front().withdrawn = true;
  std::vector<std::byte> bytes;
  wire::encode(TeamMessage{1, 12, state}, bytes);
  const auto read = wire::decode<TeamMessage>(bytes);
  ASSERT_TRUE(read) << read.error().text();
  const TeamMessage& team = read.value();
  EXPECT_EQ(team.number, 12u);
  const auto& got = std::get<TeamState>(team.content);
  EXPECT_EQ(got.members, state.members);
  EXPECT_EQ(got.met, state.met);
  EXPECT_EQ(got.tasks, state.tasks);
  EXPECT_EQ(kind_of(team.content), "team_state");
}

TEST(TeamMessage, IsReadFromTheJsonThatItIsWrittenAs) {
  TeamInform inform;
  inform.mission = TeamMission{"M", EntityId{7}};
  inform.master = EntityId{3};
  inform.tasks = {{4, 0.25}};
  const auto again = [](const TeamContent& content) {
    const json::Json written = json::to_json(TeamMessage{1, 12, content});
    const auto read = json::from_json<TeamMessage>(json::Json::parse(written.dump()));
    EXPECT_TRUE(read) << written.dump();
    EXPECT_EQ(json::to_json(read.value()).dump(), written.dump());
    return read.value().content;
  };
  const auto read = std::get<TeamInform>(again(inform));
  EXPECT_EQ(read.mission, inform.mission);
  EXPECT_EQ(read.tasks.front().share, 0.25);
  inform.mission->branch.reset();
  EXPECT_EQ(std::get<TeamInform>(again(inform)).mission, inform.mission);
  EXPECT_FALSE(std::get<TeamQuery>(again(TeamQuery{})).mission) << "a newcomer has none";
}

}  // namespace
}  // namespace skein::team_message_test
