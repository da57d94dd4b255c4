// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/station/mission_control.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "skein/layer/reasoning/station/ground_station.h"
#include "skein/layer/reasoning/station/nearest_allocator.h"

namespace skein::reasoning::mission_control_test {
namespace {

// Sends every aircraft that it has to its own place, until it is told that it is done.
class Gathering final : public Mission {
 public:
  struct Script {
    MissionDemand demand;
    bool done = false;
    std::vector<EntityId> seen;  // that obey
  };
  Gathering(Script& script, const Vec2& place) : script_(script), place_(place) {}

  void step(const AgentInput& in, AgentOutput& out) override {
    script_.seen.clear();
    for (const Message& message : in.inbox) {
      const auto* report = std::get_if<AircraftReport>(&message.content);
      if (!report || !report->obeys) continue;
      script_.seen.push_back(message.from);
      if (report->task_number == 0)
        out.outbox.push_back({{}, message.from, 0, Time(), Task{1, FlyTo{place_}}});
    }
  }
  MissionDemand demand() const override { return script_.demand; }
  bool done() const override { return script_.done; }

 private:
  Script& script_;
  Vec2 place_;
};

// Aircraft that obey at once.
struct Fleet {
  explicit Fleet(std::uint32_t count)
      : tasks(count), confirmed(count, 0), silent(count) {}

  AgentOutput second(GroundStation& station, const std::vector<Command>& commands = {}) {
    std::vector<Message> inbox;
    for (std::uint32_t k = 0; k < tasks.size(); ++k) {
      if (silent[k]) continue;
      AircraftReport report;
      report.nav.p_N = {100.0 * k, 0, -100};
      report.task_number = confirmed[k];
      report.task_state = confirmed[k] > 0 ? TaskState::kFlying : TaskState::kNone;
      inbox.push_back({EntityId{k + 1}, {}, 0, Time(), report});
    }
    if (answers) inbox.push_back(*answers);
    AgentInput in;
    in.now = now += Time::from_seconds(1);
    in.inbox = inbox;
    in.commands = commands;
    AgentOutput out;
    station.step(in, out);
    for (const Message& message : out.outbox) {
      const std::uint32_t k = message.to.value - 1;
      if (const auto* task = std::get_if<Task>(&message.content)) {
        if (task->number <= confirmed[k]) continue;
        tasks[k] = task->what;
        confirmed[k] = task->number;
      } else if (const auto* change = std::get_if<TaskChange>(&message.content)) {
        if (change->number <= confirmed[k]) continue;
        if (change->action == TaskAction::kCancel) tasks[k] = Hold{};
        confirmed[k] = change->number;
      }
    }
    for (const Event& event : out.events) events.push_back(event);
    return out;
  }
  std::vector<double> north() const {  // that each flies to; -1: nowhere
    std::vector<double> all;
    for (const TaskKind& task : tasks) {
      const auto* to = std::get_if<FlyTo>(&task);
      all.push_back(to ? to->point.x() : -1);
    }
    return all;
  }
  bool has_said(EventKind kind, const std::string& text) const {
    return std::any_of(events.begin(), events.end(), [&](const Event& e) {
      return e.kind == kind && e.text.find(text) != std::string::npos;
    });
  }

  std::vector<TaskKind> tasks;
  std::vector<std::uint32_t> confirmed;
  std::vector<bool> silent;
  std::optional<Message> answers;  // besides reports
  std::vector<Event> events;
  Time now;
};

class Control : public testing::Test {
 protected:
  PlannedMission plan(const char* name, Gathering::Script& script, double north) {
    PlannedMission planned;
    planned.name = name;
    planned.mission = std::make_unique<Gathering>(script, Vec2(north, 0));
    planned.candidates = {EntityId{1}, EntityId{2}, EntityId{3}};
    planned.start = Time();
    return planned;
  }
  GroundStation make(std::vector<PlannedMission> missions) {
    GroundStationOptions options;
    options.id = EntityId{8};
    options.team = {{EntityId{1}, "a", {0, 0}},
                    {EntityId{2}, "b", {100, 0}},
                    {EntityId{3}, "c", {200, 0}}};
    return {options, std::move(missions), std::make_unique<NearestAllocator>()};
  }
  std::vector<PlannedMission> two(int min_of_second) {
    first.demand = {1, 100, Vec2(0, 0)};
    second.demand = {min_of_second, 100, Vec2(200, 0)};
    std::vector<PlannedMission> missions;
    missions.push_back(plan("first", first, 1000));
    missions.push_back(plan("second", second, 2000));
    return missions;
  }
  Gathering::Script first, second;
  Fleet fleet{3};
};

TEST_F(Control, SharesTheAircraftAndPassesOnWhatEachMissionOrders) {
  GroundStation station = make(two(2));
  for (int k = 0; k < 4; ++k) fleet.second(station);
  EXPECT_EQ(fleet.north(), (std::vector<double>{1000, 2000, 2000}));
  EXPECT_EQ(first.seen, std::vector<EntityId>{EntityId{1}});
}

TEST_F(Control, AnEndedMissionFreesItsAircraftForTheOthers) {
  GroundStation station = make(two(2));
  for (int k = 0; k < 4; ++k) fleet.second(station);
  second.done = true;
  for (int k = 0; k < 4; ++k) fleet.second(station);
  EXPECT_TRUE(fleet.has_said(EventKind::kMission, "second is over"));
  EXPECT_EQ(fleet.north(), (std::vector<double>{1000, 1000, 1000}));
}

TEST_F(Control, AMissionThatLosesAnAircraftGetsAnother) {
  GroundStation station = make(two(1));
  for (int k = 0; k < 4; ++k) fleet.second(station);
  ASSERT_EQ(fleet.north()[2], 2000);
  first.demand.max = 2;
  second.demand.min = second.demand.max = 1;
  fleet.silent[2] = true;
  for (int k = 0; k < 10; ++k) fleet.second(station);
  EXPECT_EQ(first.seen.size() + second.seen.size(), 2u);
  EXPECT_EQ(first.seen.size(), 2u) << "equally important missions take nobody away";
}

TEST_F(Control, MissionsBeginWhenTheirConditionIsMet) {
  std::vector<PlannedMission> missions = two(1);
  missions[0].length = Time::from_seconds(5);
  missions[1].start.reset();
  missions[1].after = "first";
  first.demand.max = second.demand.max = 3;
  GroundStation station = make(std::move(missions));
  for (int k = 0; k < 4; ++k) fleet.second(station);
  EXPECT_EQ(fleet.north(), (std::vector<double>{1000, 1000, 1000}));
  for (int k = 0; k < 6; ++k) fleet.second(station);
  EXPECT_TRUE(fleet.has_said(EventKind::kMission, "second begins"));
  EXPECT_EQ(fleet.north(), (std::vector<double>{2000, 2000, 2000}));
}

TEST_F(Control, TheOperatorStartsPausesAndEndsMissions) {
  std::vector<PlannedMission> missions = two(1);
  missions[1].start.reset();
  GroundStation station = make(std::move(missions));
  fleet.second(station);
  EXPECT_EQ(second.seen.size(), 0u);
  fleet.second(station, {MissionCommand{MissionAction::kStart, "second"}});
  fleet.second(station, {MissionCommand{MissionAction::kPause, "first"}});
  fleet.second(station);
  EXPECT_TRUE(std::holds_alternative<Loiter>(fleet.tasks[0]));
  fleet.second(station, {MissionCommand{MissionAction::kResume, "first"}});
  fleet.second(station, {MissionCommand{MissionAction::kEnd, "second"}});
  for (int k = 0; k < 3; ++k) fleet.second(station);
  EXPECT_EQ(first.seen.size(), 3u);
  fleet.second(station, {MissionCommand{MissionAction::kPause, "third"}});
  EXPECT_TRUE(fleet.has_said(EventKind::kCommandRefused, "third"));
}

TEST_F(Control, WhatOneHasNotDoneIsGivenToAnother) {
  GroundStation station = make({});
  fleet.second(station, {TaskCommand{"a", FlyRoute{{{0, 0}, {500, 0}}, 4, {}}}});
  fleet.second(station, {TaskChangeCommand{"a", TaskAction::kCancel, "b"}});
  fleet.second(station);
  EXPECT_TRUE(std::holds_alternative<Hold>(fleet.tasks[0]));
  EXPECT_EQ(std::get<FlyRoute>(fleet.tasks[1]).laps, 4);
}

TEST_F(Control, HeightAndSpeedAreSaidAgainUntilTheAircraftKnowsThem) {
  GroundStation station = make({});
  const auto said = [](const AgentOutput& out) -> std::optional<FlightChange> {
    for (const Message& message : out.outbox)
      if (const auto* change = std::get_if<FlightChange>(&message.content)) {
        EXPECT_EQ(message.to, EntityId{2});
        return *change;
      }
    return std::nullopt;
  };
  const auto high = said(fleet.second(station, {FlightChangeCommand{"b", 150, {}}}));
  ASSERT_TRUE(high);
  EXPECT_EQ(high->altitude_agl, 150);
  EXPECT_FALSE(high->airspeed);
  // Lost: what is said next has both.
  const auto both = said(fleet.second(station, {FlightChangeCommand{"b", {}, 22}}));
  ASSERT_TRUE(both);
  EXPECT_GT(both->number, high->number);
  EXPECT_EQ(both->altitude_agl, 150);
  EXPECT_EQ(both->airspeed, 22);
  int again = 0;
  for (int k = 0; k < 10; ++k) again += said(fleet.second(station)).has_value();
  EXPECT_GE(again, 2);
  fleet.answers = {EntityId{2}, {}, 0, Time(), *both};
  fleet.second(station);
  fleet.answers.reset();
  for (int k = 0; k < 10; ++k) EXPECT_FALSE(said(fleet.second(station)));
  // What it knows is not ordered anew with the next.
  const auto slower = said(fleet.second(station, {FlightChangeCommand{"b", {}, 20}}));
  ASSERT_TRUE(slower);
  EXPECT_FALSE(slower->altitude_agl);
  EXPECT_EQ(slower->airspeed, 20);
}

TEST_F(Control, NamesOfOthersBecomeTheirNumbers) {
  GroundStation station = make({});
  fleet.second(station, {TaskCommand{"a", FollowLeader{{}, {-30, 0}}, {"c"}}});
  fleet.second(station, {TaskCommand{"b", Relay{}, {"station", "c"}}});
  fleet.second(station);
  EXPECT_EQ(std::get<FollowLeader>(fleet.tasks[0]).leader, EntityId{3});
  EXPECT_EQ(std::get<Relay>(fleet.tasks[1]).first, EntityId{8});
  EXPECT_EQ(std::get<Relay>(fleet.tasks[1]).second, EntityId{3});
  fleet.second(station, {TaskCommand{"b", Relay{}, {"station", "z"}}});
  EXPECT_TRUE(fleet.has_said(EventKind::kCommandRefused, "\"z\""));
}

}  // namespace
}  // namespace skein::reasoning::mission_control_test
