// SPDX-License-Identifier: Apache-2.0
// Teams that lead themselves fly in whole scenarios.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "skein/assemble/test/whole_flight.h"

namespace skein::assemble::team_flight_test {
namespace {

std::string shipped_team() {
  std::ifstream in(SKEIN_SOURCE_DIR "/scenarios/team.yaml");
  std::ostringstream content;
  content << in.rdbuf();
  return content.str();
}

// Entity 0 is the station; aircraft 1 to 3 take three tasks.
std::string three(const std::string& structure, const std::string& more = "",
                  const std::string& range = "0", const std::string& aircraft = "") {
  return R"(
duration_s: 400
seed: 3
environment: {terrain: flat, wind: {kind: uniform, speed_mps: 3}, phenomena: []}
radio: {kind: ideal, loss: 0.2, delay_s: 0.2, range_m: )" +
         range + R"(}
stations:
  - position_m: [0, 0]
    team: {structure: )" +
         structure + R"(}
aircraft:
  - name: scout
    count: 3
    altitude_agl_m: 100
    sensors: [gnss, air-data]
    start: {placement: line, spacing_m: 150}
)" + aircraft +
         R"(
missions:
  - kind: team
    name: three
    tasks:
      - {task: "measure 500,-400 stay 30"}
      - {task: "measure 600,0 stay 30"}
      - {task: "measure 500,400 stay 30"}
)" + more;
}

// Numbers of the team's tasks that were done, and how often.
std::map<std::uint32_t, int> tasks_done(const FlightLog& log) {
  std::map<std::uint32_t, int> done;
  for (const Event& event : log.events)
    if (event.kind == EventKind::kTaskDone && event.numbers.team_task)
      ++done[*event.numbers.team_task];
  return done;
}

std::set<std::uint32_t> who(const FlightLog& log, EventKind kind) {
  std::set<std::uint32_t> ids;
  for (const Event& event : log.events)
    if (event.kind == kind) ids.insert(event.entity.value);
  return ids;
}

TEST(TeamFlight, FindsItsLeaderAndSharesTheTasksOut) {
  const FlightLog log = fly(three("master"));
  EXPECT_EQ(tasks_done(log).size(), 3u) << log.story();
  EXPECT_EQ(who(log, EventKind::kTeamTask).size(), 3u) << log.story();
  EXPECT_EQ(who(log, EventKind::kTeamSelected), (std::set<std::uint32_t>{0, 1}))
      << log.story();
  EXPECT_NE(log.find(EventKind::kMission, "three is over"), nullptr) << log.story();
  EXPECT_EQ(log.figure("team_masters"), 2);
  EXPECT_EQ(log.figure("team_double_max_s"), 0) << log.story();
}

TEST(TeamFlight, NothingOfItIsThereWithoutAStructure) {
  EXPECT_THROW(fly(three("none")), std::exception);
}

TEST(TeamFlight, WhoFliesItIsTheTeamsOwnMatter) {
  EXPECT_THROW(fly(three("master", "    aircraft: [scout]\n")), std::exception);
  EXPECT_THROW(fly(three("master", "    then: land\n")), std::exception);
}

TEST(TeamFlight, IsTheSameAgainWithAnyNumberOfThreads) {
  const std::string text = three("master");
  Flown two;
  two.threads = 2;
  EXPECT_EQ(fly(text).hash(), fly(text, two).hash());
}

TEST(TeamFlight, TheStationLeadsWhereTheScenarioSaysSo) {
  const FlightLog log = fly(three("fixed-master"));
  EXPECT_EQ(tasks_done(log).size(), 3u) << log.story();
  EXPECT_EQ(who(log, EventKind::kTeamSelected), std::set<std::uint32_t>{0})
      << log.story();
}

TEST(TeamFlight, WithoutAMasterTheHighestBidWins) {
  const FlightLog log = fly(three("auction"));
  EXPECT_EQ(tasks_done(log).size(), 3u) << log.story();
  EXPECT_TRUE(who(log, EventKind::kTeamSelected).empty()) << log.story();
}

TEST(TeamFlight, AllTasksAreDoneAlthoughTheMasterIsLostAndMembersComeAndGo) {
  const FlightLog log = fly(shipped_team());
  const auto done = tasks_done(log);
  EXPECT_EQ(done.size(), 10u) << log.story();
  // Twice where the last to do it was lost before it could say so.
  int again = 0;
  for (const auto& [task, times] : done) again += times - 1;
  EXPECT_LE(again, 1) << log.story();
  EXPECT_GE(log.figure("team_masters"), 3) << log.story();
  EXPECT_NE(log.find(EventKind::kMission, "valley is over"), nullptr) << log.story();
  // Scout 1 crashes, scout 3 lands; who comes later flies tasks.
  const auto flew = who(log, EventKind::kTeamTask);
  EXPECT_TRUE(flew.contains(4)) << log.story();
  EXPECT_TRUE(flew.contains(5)) << log.story();
}

TEST(TeamFlight, GoesOnOutOfReachOfTheStation) {
  // Tasks lie 1.2 km and more away, the station is heard within 900 m.
  std::string text = three("master", R"(      - {task: "measure 1800,0 stay 30"}
      - {task: "measure 1800,300 stay 30"}
      - {task: "measure 1800,-300 stay 30"}
      - {task: "measure 1500,0 stay 30"}
)",
                           "900");
  const FlightLog log = fly(text);
  EXPECT_EQ(tasks_done(log).size(), 7u) << log.story();
}

TEST(TeamFlight, AnOrderOfTheOperatorGoesBeforeTheTeams) {
  const FlightLog log = fly(three("master", R"(commands:
  - {at_s: 30, do: "task scout-2 measure -500,0 stay 20"}
)"));
  EXPECT_EQ(tasks_done(log).size(), 3u) << log.story();
  const Event* own = log.find(EventKind::kTaskDone, "task 1: measure");
  ASSERT_NE(own, nullptr) << log.story();
  EXPECT_EQ(own->entity.value, 2u);
}

// The first event of that kind whose text holds `part`.
const Event* with_text(const FlightLog& log, EventKind kind, std::string_view part) {
  for (const Event& event : log.events)
    if (event.kind == kind && event.text.find(part) != std::string::npos) return &event;
  return nullptr;
}

TEST(TeamFlight, WhatNeedsApprovalIsFlownWhenTheOperatorSaysSo) {
  const std::string commands = R"(commands:
  - {at_s: 5, do: "allocation approve"}
  - {at_s: 60, do: "allocation approve 99"}
  - {at_s: 61, do: "allocation approve 1 nobody"}
  - {at_s: 100, do: "allocation approve"}
  - {at_s: 200, do: "allocation approve 1"}
)";
  const FlightLog log = fly(three("master, approval: true", commands));
  EXPECT_EQ(tasks_done(log).size(), 3u) << log.story();
  const Event* proposed =
      with_text(log, EventKind::kAllocationProposed, "1 of scout-1: scout-1 flies ");
  ASSERT_NE(proposed, nullptr) << log.story();
  EXPECT_EQ(proposed->entity.value, 0u) << "the station says so";
  for (const Event& event : log.events)
    if (event.kind == EventKind::kTeamTask) {
      EXPECT_GE(event.time.seconds(), 100) << log.story();
    }
  EXPECT_NE(with_text(log, EventKind::kAllocationOver, "1 of scout-1 is in force"),
            nullptr)
      << log.story();
  EXPECT_NE(
      with_text(log, EventKind::kCommandRefused, "allocation of station: none waits"),
      nullptr)
      << log.story();
  EXPECT_NE(with_text(log, EventKind::kCommandRefused,
                      "allocation of station: 99 does not wait"),
            nullptr)
      << log.story();
  EXPECT_NE(with_text(log, EventKind::kCommandRefused, "there is no station \"nobody\""),
            nullptr)
      << log.story();
  EXPECT_GE(log.figure("team_allocations_approved"), 1);
}

TEST(TeamFlight, WhereNothingNeedsApprovalADecisionIsRefused) {
  const std::string commands = R"(commands:
  - {at_s: 60, do: "allocation approve"}
)";
  const FlightLog free = fly(three("master", commands));
  EXPECT_NE(with_text(free, EventKind::kCommandRefused,
                      "allocation of station: allocations of this team need no approval"),
            nullptr)
      << free.story();
  EXPECT_THROW(fly(three("auction, approval: true")), std::exception);
}

// Times at which the team's tasks were done, by their numbers.
std::map<std::uint32_t, Time> times_done(const FlightLog& log) {
  std::map<std::uint32_t, Time> times;
  for (const Event& event : log.events)
    if (event.kind == EventKind::kTaskDone && event.numbers.team_task)
      times.emplace(*event.numbers.team_task, event.time);
  return times;
}

std::string ordered(const std::string& last, const std::string& commands = "") {
  return three("master, allocation: sequences") + R"(
      - {task: "measure 900,200 stay 30", name: last, after: )" +
         last + R"(}
      - {task: "measure -200,-400 stay 30", name: first}
      - {task: "measure -300,400 stay 30", name: second}
)" + commands;
}

TEST(TeamFlight, FliesSequencesAndKeepsTheirOrder) {
  const FlightLog log = fly(ordered("[first, second]"));
  const auto times = times_done(log);
  ASSERT_EQ(times.size(), 6u) << log.story();
  // Added behind those that it waits for: 4 and 5 are first and second.
  EXPECT_GT(times.at(6), times.at(4)) << log.story();
  EXPECT_GT(times.at(6), times.at(5)) << log.story();
  EXPECT_EQ(log.figure("team_double_max_s"), 0) << log.story();
  EXPECT_NE(log.find(EventKind::kMission, "three is over"), nullptr) << log.story();
}

TEST(TeamFlight, TasksComeAfterOthersThatThereAre) {
  EXPECT_THROW(fly(ordered("[third]")), std::exception);
  EXPECT_THROW(fly(ordered("[last]")), std::exception);
}

TEST(TeamFlight, TheOperatorAddsChangesAndWithdrawsTasks) {
  const FlightLog log = fly(ordered("[first]", R"(
commands:
  - {at_s: 40, do: "team withdraw 1"}
  - {at_s: 41, do: "team change 5 measure -350,450 stay 20"}
  - {at_s: 42, do: "team add after 2,3 measure 300,0 stay 10"}
  - {at_s: 43, do: "team withdraw 77"}
)"));
  const auto times = times_done(log);
  EXPECT_FALSE(times.contains(1)) << log.story();
  ASSERT_TRUE(times.contains(7) || times.contains(5)) << log.story();
  ASSERT_TRUE(times.contains(8)) << log.story();
  EXPECT_GT(times.at(8), std::max(times.at(2), times.at(3))) << log.story();
  EXPECT_NE(log.find(EventKind::kTeamTaskWithdrawn, "1: measure"), nullptr)
      << log.story();
  EXPECT_NE(
      log.find(EventKind::kCommandRefused, "team task of station: there is no task 77."),
      nullptr)
      << log.story();
  EXPECT_NE(log.find(EventKind::kMission, "three is over"), nullptr) << log.story();
}

}  // namespace
}  // namespace skein::assemble::team_flight_test
