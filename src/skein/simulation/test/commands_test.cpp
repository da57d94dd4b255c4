// SPDX-License-Identifier: Apache-2.0
// Commands to a run: given, recorded, and given again.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "skein/simulation/paced_run.h"
#include "skein/simulation/test/gliders.h"

namespace skein::simulation::commands_test {
namespace {

using namespace test;

// Gives commands when it is asked for the n-th time, from 1.
class Operator : public Silent {
 public:
  std::map<int, std::vector<Command>> plan;
  int asked = 0;
  std::vector<CommandRecord> commands() override {
    std::vector<CommandRecord> given;
    for (const Command& command : plan[++asked])
      given.push_back({Time(), "operator", command});
    return given;
  }
};

// A ground station that puts into force what is commanded, and writes when.
class Office : public Agent {
 public:
  void step(const AgentInput& in, AgentOutput& out) override {
    for (const Command& command : in.commands)
      if (const auto* change = std::get_if<ZoneChange>(&command)) {
        out.events.push_back(
            {in.now, EntityId{2}, EventLabel::named("command"), change->zone.name});
        out.records.emplace_back(*change);
      }
  }
};

class ZoneNotes : public Notes {
 public:
  void record(const Record& record) override {
    Notes::record(record);
    if (const auto* zone = std::get_if<ZoneRecord>(&record))
      zones += fmt::format("{:.1f} {} {};", zone->time.seconds(), zone->change.on,
                           zone->change.zone.name);
  }
  std::string zones;
};

void add_station(World& world) {
  Entity station;
  station.name = "station";
  station.kind = "station";
  station.agent = std::make_unique<Office>();
  station.agent_period = Time::from_seconds(0.5);
  station.active = {{Time(), Time::from_seconds(100)}};
  world.entities.push_back(std::move(station));
}

TEST(Run, PassesCommandsOnToGroundStationsAndRecordsThem) {
  World world = make_world(2);
  add_station(world);
  world.zones.push_back({.area = Disc{{0, 0}, 50}, .name = "known"});
  ZoneNotes notes;
  Operator console;
  console.plan[10] = {ZoneChange{0, true, {.area = Disc{{0, 0}, 50}, .name = "drawn"}}};
  ASSERT_TRUE(run_paced(world, seconds(3), notes, console).ok());
  // Asked at 0.9 s, thought of at the station's next step; aircraft get nothing of it.
  EXPECT_EQ(notes.zones, "0.0 true known;1.0 true drawn;");
  EXPECT_NE(notes.kinds.find("command"), std::string::npos);
  ASSERT_EQ(notes.commands.size(), 1u);
  EXPECT_EQ(notes.commands[0].time, Time::from_seconds(0.9));
  EXPECT_EQ(notes.commands[0].sender, "operator");
}

// Where it came in, by whoever serves the aircraft: the run only notes it.
TEST(Run, AnOrderThatWasRefusedIsAnEventOfItsAircraft) {
  World world = make_world(2);
  const std::string name = world.entities[1].name;
  Notes notes;
  Operator console;
  console.plan[5] = {RefusedCommand{name, "not signed"}, RefusedCommand{"", "for all"}};
  ASSERT_TRUE(run_paced(world, seconds(2), notes, console).ok());
  EXPECT_NE(notes.text.find(" 1 command-refused not signed;"), std::string::npos)
      << notes.text;
  EXPECT_NE(notes.text.find(" command-refused for all;"), std::string::npos);
  ASSERT_EQ(notes.commands.size(), 2u) << "recorded, so that it is there again";
}

TEST(Run, WhatIsCommandedBeforeTheFirstStepReachesStationsToo) {
  World world = make_world(1);
  add_station(world);
  ZoneNotes notes;
  Operator console;
  console.plan[1] = {ZoneChange{0, true, {.area = Disc{{0, 0}, 50}, .name = "first"}}};
  ASSERT_TRUE(run_paced(world, seconds(1), notes, console).ok());
  EXPECT_EQ(notes.zones, "0.0 true first;");
}

TEST(Run, APausedRunStandsStillAndMakesTheStepsThatAreAskedFor) {
  World world = make_world(1);
  Notes notes;
  Operator console;
  // Asked once a step, and again and again while it stands still.
  console.plan[11] = {PauseCommand{true}};
  console.plan[14] = {StepCommand{3}};
  console.plan[20] = {PauseCommand{false}};
  RunOptions options = seconds(3);
  ASSERT_TRUE(run_paced(world, options, notes, console).ok());
  ASSERT_EQ(notes.commands.size(), 3u);
  EXPECT_EQ(notes.commands[0].time, Time::from_seconds(1.0));
  EXPECT_EQ(notes.commands[1].time, Time::from_seconds(1.0));
  EXPECT_EQ(notes.commands[2].time, Time::from_seconds(1.3));
  EXPECT_EQ(notes.truths, 31) << "nothing is lost by standing still";
}

TEST(Run, CommandsOfARecordedRunGiveTheSameRecordsAgain) {
  const auto fly = [](RunOptions options, Operator& console, Notes& notes) {
    World world =
        make_world(3, Time::from_seconds(0.2), 0, [](std::size_t, VehicleParts& parts) {
          parts.breakable = {{VehicleFault::Kind::kLink, 0, {}, {}, "link"}};
        });
    world.entities[2].active.clear();
    ASSERT_TRUE(run_paced(world, options, notes, console).ok());
  };
  Notes first, second;
  Operator console, nobody;
  console.plan[5] = {WindCommand{{3, 4}}, FaultCommand{"a0", "link", true}};
  console.plan[12] = {PauseCommand{true}};
  console.plan[15] = {AddCommand{"a2"}, PauseCommand{false}, SpeedCommand{1000}};
  console.plan[30] = {RemoveCommand{"a1"}, FaultCommand{"a0", "link", false},
                      FaultCommand{"a0", "wing", true}, AddCommand{"nobody"}};
  fly(seconds(6), console, first);
  RunOptions again = seconds(6);
  again.commands = first.commands;
  again.clock_by_command = false;
  fly(again, nobody, second);
  EXPECT_EQ(first.text, second.text);
  ASSERT_EQ(second.commands.size(), 10u);
  EXPECT_EQ(first.kinds,
            "joined joined failure joined command-refused command-refused left "
            "repaired ");
}

}  // namespace
}  // namespace skein::simulation::commands_test
