// SPDX-License-Identifier: Apache-2.0
#include "skein/data/command/command_text.h"

#include <gtest/gtest.h>

#include <string>

#include "skein/base/random.h"
#include "skein/data/describe/json.h"
#include "skein/data/describe/wire.h"

namespace skein::command_text_test {
namespace {

template <class T>
T parsed(std::string_view line) {
  const auto command = parse_command(line);
  EXPECT_TRUE(command.ok()) << line << ": " << command.error().text();
  if (!command || !std::holds_alternative<T>(command.value())) {
    ADD_FAILURE() << line;
    return {};
  }
  return std::get<T>(command.value());
}

// Of whatever bytes it is: what is taken as a command can be written as JSON, which is
// strict about text, and coded.
void check_texts_of(const std::string& line) {
  const auto command = parse_command(line);
  if (!command) return;
  ASSERT_NO_THROW(static_cast<void>(json::to_json(command.value()).dump())) << line;
  std::vector<std::byte> coded;
  wire::encode(command.value(), coded);
  ASSERT_TRUE(wire::decode<Command>(coded)) << line;
}

TEST(CommandText, TextsOfACommandAreValidWhateverBytesWereTyped) {
  EXPECT_EQ(parsed<AddCommand>("add a\xff\xfe").aircraft, "a\uFFFD\uFFFD");
  EXPECT_EQ(parsed<AddCommand>(std::string_view("add a\0b", 7)).aircraft, "a\uFFFDb");
  EXPECT_EQ(parsed<ZoneChange>("zone on \xb0 circle 0,0 50").zone.name, "\uFFFD");
  const std::vector<std::string> lines = {
      "zone on field circle 0,0 50",
      "task uav-1 route 0,0 10,5 laps 3",
      "task uav-1 give uav-2",
      "task uav-1 leader uav-2 -20,10",
      "task uav-1 plan file plan.kml",
      "team of base add after 1,2 group survey 0,0 9,0 9,9",
      "fault uav-1 sensor imu",
      "mission start fire",
      "allocation reject 3 base",
      "flight uav-1 speed 18 height 150",
      R"({"kind":"task","aircraft":"uav-1","what":{"kind":"fly_to","north_m":1}})"};
  RandomStream random(38, 0, Purpose::kTest);
  for (int run = 0; run < 20'000; ++run) {
    std::string line = lines[random.bits() % lines.size()];
    for (std::uint64_t k = random.bits() % 4; k-- > 0;) {
      const auto at = random.bits() % line.size();
      if (random.bits() % 2 == 0)
        line[at] = static_cast<char>(random.bits() % 256);
      else
        line.insert(at, 1, static_cast<char>(0x80 + random.bits() % 128));
    }
    check_texts_of(line);
  }
}

TEST(Wire, TextsOfOthersAreValid) {
  std::vector<std::byte> coded;
  wire::encode(Command(AddCommand{"a\xff\xfe"}), coded);
  const auto command = wire::decode<Command>(coded);
  ASSERT_TRUE(command);
  EXPECT_EQ(std::get<AddCommand>(command.value()).aircraft, "a\uFFFD\uFFFD");
}

TEST(CommandText, SaysEveryCommand) {
  EXPECT_TRUE(parsed<ZoneChange>("zone on a circle 0,0 50").on);
  const TaskCommand task = parsed<TaskCommand>("task uav-1 route 0,0 10,5 laps 3");
  EXPECT_EQ(task.aircraft, "uav-1");
  EXPECT_EQ(std::get<FlyRoute>(task.what).laps, 3);
  EXPECT_EQ(std::get<FlyRoute>(task.what).points.size(), 2u);
  const TaskCommand tour = parsed<TaskCommand>("task uav-1 tour 0,0 10,5 laps 3");
  EXPECT_EQ(std::get<FlyTour>(tour.what).laps, 3);
  EXPECT_EQ(std::get<FlyTour>(tour.what).points.at(1), Vec2(10, 5));
  const auto edge = std::get<FollowEdge>(
      parsed<TaskCommand>("task a follow_edge 1,2 counterclockwise").what);
  EXPECT_FALSE(edge.clockwise);
  EXPECT_EQ(edge.start, Vec2(1, 2));
  EXPECT_DOUBLE_EQ(
      std::get<FlyCourse>(parsed<TaskCommand>("task a course 90").what).course,
      geo::kPi / 2);
  EXPECT_EQ(parsed<MissionCommand>("mission pause").action, MissionAction::kPause);
  EXPECT_EQ(parsed<MissionCommand>("mission resume").mission, "");
  EXPECT_EQ(parsed<MissionCommand>("mission start fire").mission, "fire");
  EXPECT_TRUE(parsed<PauseCommand>("pause").paused);
  EXPECT_FALSE(parsed<PauseCommand>("resume").paused);
  EXPECT_EQ(parsed<StepCommand>("step").steps, 1u);
  EXPECT_EQ(parsed<StepCommand>("step 25").steps, 25u);
  EXPECT_EQ(parsed<SpeedCommand>("speed fast").factor, 0);
  EXPECT_EQ(parsed<SpeedCommand>("speed 2.5").factor, 2.5);
  EXPECT_EQ(parsed<FaultCommand>("fault a sensor imu").part, "sensor imu");
  EXPECT_FALSE(parsed<FaultCommand>("repair a motor").fails);
  EXPECT_LT((parsed<WindCommand>("wind 3 270").added - Vec2(0, 3)).norm(), 1e-12);
  EXPECT_EQ(parsed<WindCommand>("wind off").added, Vec2(0, 0));
  EXPECT_EQ(parsed<AddCommand>("add b").aircraft, "b");
  EXPECT_EQ(parsed<AllocationCommand>("allocation approve").number, 0u);
  const auto rejected = parsed<AllocationCommand>("allocation reject 3 base");
  EXPECT_EQ(rejected.action, AllocationAction::kReject);
  EXPECT_EQ(rejected.number, 3u);
  EXPECT_EQ(rejected.station, "base");
  EXPECT_EQ(parsed<RemoveCommand>("remove b").aircraft, "b");
  EXPECT_EQ(parsed<HandBackCommand>("hand-back b").aircraft, "b");
  const auto both = parsed<FlightChangeCommand>("flight a speed 18 height 150");
  EXPECT_EQ(both.aircraft, "a");
  EXPECT_EQ(both.altitude_agl, 150);
  EXPECT_EQ(both.airspeed, 18);
  EXPECT_FALSE(parsed<FlightChangeCommand>("flight a height 90").airspeed);
}

TEST(CommandText, RefusesEverythingElseAndSaysWhy) {
  for (const char* line : {"",
                           "fly",
                           "allocation",
                           "allocation approve 0",
                           "allocation approve x",
                           "allocation keep",
                           "allocation approve 1 base now",
                           "task",
                           "task a",
                           "task a loiter",
                           "task a loiter 0",
                           "task a fly_to x,y",
                           "task a course north",
                           "task a line 0,0",
                           "task a route 0,0 laps 0",
                           "task a route laps 2",
                           "task a tour 0,0",
                           "task a tour 0,0 5,5 laps 0",
                           "task a follow_edge 0,0 left",
                           "task a loiter inf,0",
                           "flight",
                           "flight a",
                           "flight a height",
                           "flight a height x",
                           "flight a height 0",
                           "flight a speed -3",
                           "flight a speed nan",
                           "flight a depth 3",
                           "flight a speed 3 speed 4",
                           "flight a height 3 speed 4 now",
                           "mission",
                           "mission stop",
                           "pause now",
                           "step 0",
                           "step 1.5",
                           "step 1 2",
                           "speed",
                           "speed 0",
                           "speed -1",
                           "speed nan",
                           "wind 3",
                           "wind -3 0",
                           "wind 3 nan",
                           "wind 1000 0",
                           "fault a",
                           "repair",
                           "add",
                           "add a b",
                           "remove",
                           "zone up a",
                           "team",
                           "team add",
                           "team add after x fly_to 0,0",
                           "team add after 0 fly_to 0,0",
                           "team add group",
                           "team add hold",
                           "team add after 1, fly_to 0,0",
                           "team add after 1,,2 fly_to 0,0",
                           "team add nonsense 0,0",
                           "team add fly_plan f.csv",
                           "team withdraw",
                           "team withdraw 0",
                           "team withdraw 1 2",
                           "team change fly_to 0,0",
                           "team change 3",
                           "team of base",
                           "team drop 3"}) {
    const auto command = parse_command(line);
    ASSERT_FALSE(command.ok()) << line;
    EXPECT_FALSE(command.error().message.empty()) << line;
    EXPECT_FALSE(command.error().hint.empty()) << line;
  }
}

TEST(CommandText, TasksOfATeamComeAfterOthers) {
  const auto added =
      parsed<TeamTaskCommand>("team of base add after 2,3 group measure 10,20 stay 30");
  EXPECT_EQ(added.action, TeamTaskAction::kAdd);
  EXPECT_EQ(added.station, "base");
  EXPECT_EQ(added.after, (std::vector<std::uint32_t>{2, 3}));
  EXPECT_TRUE(added.group);
  EXPECT_EQ(std::get<Measure>(added.what).stay, 30);
  const auto plain = parsed<TeamTaskCommand>("team add fly_to 1,2");
  EXPECT_TRUE(plain.after.empty() && !plain.group && plain.station.empty());
  const auto withdrawn = parsed<TeamTaskCommand>("team withdraw 7");
  EXPECT_EQ(withdrawn.action, TeamTaskAction::kWithdraw);
  EXPECT_EQ(withdrawn.number, 7u);
  const auto changed = parsed<TeamTaskCommand>("team change 7 fly_to 1,2");
  EXPECT_EQ(changed.action, TeamTaskAction::kChange);
  EXPECT_EQ(std::get<FlyTo>(changed.what).point, Vec2(1, 2));
  for (
      const char* json :
      {R"({"kind": "change_team_task", "action": "withdraw"})",
       R"({"kind": "change_team_task"})",
       R"({"kind": "change_team_task", "action": "change", "number": 3, "after": [1], "what": {"kind": "fly_to", "north_m": 1, "east_m": 2}})"})
    EXPECT_FALSE(parse_command(json).ok()) << json;
}

TEST(CommandText, TakesWhatProgramsWriteAsJson) {
  const auto task = parse_command(
      R"( {"kind": "task", "aircraft": "uav-1", "what": {"kind": "fly_to", "north_m": 500, "east_m": -200}})");
  ASSERT_TRUE(task.ok()) << task.error().text();
  const auto& given = std::get<TaskCommand>(task.value());
  EXPECT_EQ(given.aircraft, "uav-1");
  EXPECT_EQ(std::get<FlyTo>(given.what).point, Vec2(500, -200));
  const auto speed = parse_command(R"({"kind": "speed", "factor": 10})");
  ASSERT_TRUE(speed.ok());
  EXPECT_EQ(std::get<SpeedCommand>(speed.value()).factor, 10);
}

TEST(CommandText, RefusesJsonThatIsNoCommandOrOutOfRange) {
  for (const char* line :
       {"{", "{}", R"({"kind": "dance"})", R"({"kind": "speed", "factor": -1})",
        R"({"kind": "speed", "factor": "ten"})", R"({"kind": "step", "steps": 0})",
        R"({"kind": "wind", "wind_north_mps": 1e9})",
        R"({"kind": "task", "aircraft": "a", "what": {"kind": "fly_route"}})",
        R"({"kind": "task", "aircraft": "a", "what": {"kind": "fly_tour"}})",
        R"({"kind": "task", "aircraft": "a", "what": {"kind": "follow_line"}})",
        R"({"kind": "change_flight", "aircraft": "a"})",
        R"({"kind": "change_flight", "aircraft": "a", "airspeed_mps": -1})",
        R"({"kind": "zone_change", "number": 3})"}) {
    const auto command = parse_command(line);
    EXPECT_FALSE(command.ok()) << line;
    EXPECT_TRUE(command.ok() || !command.error().text().empty()) << line;
  }
}

}  // namespace
}  // namespace skein::command_text_test
