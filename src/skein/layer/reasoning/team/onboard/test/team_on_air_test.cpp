// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <utility>

#include "skein/layer/reasoning/team/onboard/task_needs.h"
#include "skein/layer/reasoning/team/onboard/test/air_team.h"

namespace skein::reasoning::team_on_air_test {
namespace {

std::vector<WantedTask> measurements(int count) {
  std::vector<WantedTask> all;
  for (int k = 0; k < count; ++k)
    all.push_back({Measure{{300.0 * k, 500}, 30}, 0, false});
  return all;
}

AirTeam three(TeamStructure structure, double loss) {
  AirTeam team(structure);
  team.loss = loss;
  for (const std::uint32_t id : {1U, 2U, 3U}) team.add(id, {0, 100.0 * id});
  return team;
}

TEST(TeamOnAir, TheStationHandsOverAndTheAircraftShareTheTasks) {
  AirTeam team = three(TeamStructure::kMaster, 0.2);
  const auto numbers = team.desk->hand_in("M", measurements(3), Time());
  team.task_time = 1e6;
  team.run(60);
  EXPECT_EQ(team.masters(), std::set<std::uint32_t>{1}) << team.story();
  EXPECT_EQ(team.leads.at(EntityId{0}).master, EntityId{1}) << "the station knows";
  EXPECT_EQ(team.flown(), (std::multiset<std::uint32_t>{1, 2, 3})) << team.story();
  EXPECT_FALSE(team.desk->is_done(numbers.front()));
}

TEST(TeamOnAir, WhoHasNothingNewToSayOnlySaysThatItIsThere) {
  AirTeam team = three(TeamStructure::kMaster, 0.1);
  team.desk->hand_in("M", measurements(3), Time());
  team.task_time = 1e6;
  team.run(60);
  team.said.clear();
  team.run(60);
  EXPECT_GE(team.said["team_here"], 3 * team.said["team_inform"]);
  EXPECT_GE(team.said["team_inform"], 30) << "three followers, every fifth query";
  team.said.clear();
  for (auto& [id, one] : team.aircraft) one.work.free = false;
  team.run(4);
  EXPECT_GT(team.said["team_inform"], team.said["team_here"]) << "news are said in full";
}

TEST(TeamOnAir, GoesOnWhenItsMasterIsLostAndTheStationIsOutOfReach) {
  AirTeam team = three(TeamStructure::kMaster, 0.2);
  const auto numbers = team.desk->hand_in("M", measurements(7), Time());
  team.run(60);
  team.station_receives = false;
  team.aircraft.erase(EntityId{1});
  team.run(300);
  EXPECT_EQ(team.masters(), std::set<std::uint32_t>{2}) << team.story();
  EXPECT_EQ(team.executed.size(), 7u) << team.story();
  for (const auto& [task, times] : team.executed) EXPECT_LE(times, 2) << task;
  // In reach again the station follows, and hears what is done.
  team.station_receives = true;
  team.run(60);
  EXPECT_EQ(team.masters(), std::set<std::uint32_t>{2}) << team.story();
  for (const std::uint32_t task : numbers)
    EXPECT_TRUE(team.desk->is_done(task)) << task << "\n" << team.story();
}

TEST(TeamOnAir, TasksThatAreAddedReachTheMasterByRadio) {
  AirTeam team = three(TeamStructure::kMaster, 0.3);
  team.desk->hand_in("M", measurements(1), Time());
  team.run(120);
  ASSERT_EQ(team.executed.size(), 1u) << team.story();
  const auto more =
      team.desk->hand_in("N", measurements(3), Time::from_seconds(team.now));
  EXPECT_EQ(more, (std::vector<std::uint32_t>{2, 3, 4}));
  team.run(150);
  EXPECT_EQ(team.executed, (std::map<std::uint32_t, int>{{1, 1}, {2, 1}, {3, 1}, {4, 1}}))
      << team.story();
  EXPECT_TRUE(team.desk->is_done(4));
}

TEST(TeamOnAir, WhoComesLateGetsWhatIsLeft) {
  AirTeam team = three(TeamStructure::kMaster, 0.2);
  team.desk->hand_in("M", measurements(4), Time());
  team.task_time = 1e6;
  team.run(60);
  team.add(9, {0, 900});
  team.run(40);
  EXPECT_EQ(team.flown(), (std::multiset<std::uint32_t>{1, 2, 3, 4})) << team.story();
  EXPECT_EQ(team.masters(), std::set<std::uint32_t>{1});
}

TEST(TeamOnAir, WhoTheOperatorTakesGivesItsTaskToAnother) {
  AirTeam team = three(TeamStructure::kMaster, 0);
  team.desk->hand_in("M", measurements(2), Time());
  team.task_time = 1e6;
  team.run(60);
  EntityId busy;
  for (const auto& [id, one] : team.aircraft)
    if (one.team->task()) busy = id;
  team.aircraft.at(busy).work.free = false;
  team.run(20);
  EXPECT_EQ(team.aircraft.at(busy).team->task(), nullptr);
  EXPECT_EQ(team.flown(), (std::multiset<std::uint32_t>{1, 2})) << team.story();
}

TEST(TeamOnAir, AMasterThatAFailsafeBringsHomeHandsOver) {
  AirTeam team = three(TeamStructure::kMaster, 0.2);
  team.desk->hand_in("M", measurements(2), Time());
  team.task_time = 1e6;
  team.run(60);
  ASSERT_EQ(team.masters(), std::set<std::uint32_t>{1}) << team.story();
  TeamWork& work = team.aircraft.at(EntityId{1}).work;
  work.leaves = true;
  work.free = false;
  team.run(20);
  EXPECT_EQ(team.masters(), std::set<std::uint32_t>{2}) << team.story();
  EXPECT_EQ(team.flown(), (std::multiset<std::uint32_t>{1, 2})) << team.story();
  EXPECT_EQ(team.aircraft.at(EntityId{1}).team->task(), nullptr);
}

TEST(TeamOnAir, OnlyWhoHasTheSensorFliesATask) {
  AirTeam team(TeamStructure::kMaster);
  team.add(1, {0, 0});
  team.add(2, {5000, 0}, kCameraSensor);
  team.desk->hand_in("M", std::vector<WantedTask>{{Measure{{0, 10}, 30}, kCameraSensor}},
                     Time());
  team.task_time = 1e6;
  team.run(60);
  EXPECT_EQ(team.aircraft.at(EntityId{1}).team->task(), nullptr);
  EXPECT_NE(team.aircraft.at(EntityId{2}).team->task(), nullptr) << team.story();
}

TEST(TeamOnAir, WithoutAMasterTheHighestBidWins) {
  AirTeam team = three(TeamStructure::kAuction, 0.2);
  const auto numbers = team.desk->hand_in("M", measurements(5), Time());
  team.run(200);
  EXPECT_EQ(team.executed.size(), 5u) << team.story();
  for (const std::uint32_t task : numbers) EXPECT_TRUE(team.desk->is_done(task)) << task;
}

TEST(TeamOnAir, AStationThatAlwaysLeadsSharesTheTasks) {
  AirTeam team = three(TeamStructure::kFixedMaster, 0.2);
  const auto numbers = team.desk->hand_in("M", measurements(5), Time());
  team.run(200);
  EXPECT_EQ(team.masters(), std::set<std::uint32_t>{0}) << team.story();
  for (const std::uint32_t task : numbers) EXPECT_TRUE(team.desk->is_done(task)) << task;
}

TEST(TeamOnAir, AStationThatMeetsItsTeamAgainAndAgainNeverSplitsIt) {
  AirTeam team = three(TeamStructure::kMaster, 0.1);
  team.desk->hand_in("M", measurements(3), Time());
  team.task_time = 1e6;
  for (int k = 0; k < 4; ++k) {
    team.station_receives = true;
    team.run(60);
    EXPECT_EQ(team.masters(), std::set<std::uint32_t>{1}) << team.story();
    team.station_receives = false;
    team.run(90);
  }
  EXPECT_EQ(team.flown(), (std::multiset<std::uint32_t>{1, 2, 3})) << team.story();
}

TEST(TeamOnAir, AStationThatHearsFollowersOnlyKnowsWhatTheirMasterDoes) {
  AirTeam team = three(TeamStructure::kMaster, 0.2);
  const auto numbers = team.desk->hand_in("M", measurements(5), Time());
  team.run(30);
  ASSERT_EQ(team.masters(), std::set<std::uint32_t>{1}) << team.story();
  team.out_of_reach = {1};
  team.run(200);
  EXPECT_EQ(team.masters(), std::set<std::uint32_t>{1}) << team.story();
  EXPECT_EQ(team.leads.at(EntityId{0}).master, EntityId{1}) << team.story();
  for (const std::uint32_t task : numbers)
    EXPECT_TRUE(team.desk->is_done(task)) << task << "\n" << team.story();
}

TEST(TeamOnAir, AStationThatLedAloneHearsOfFollowersThatItsTeamHasAMaster) {
  AirTeam team = three(TeamStructure::kMaster, 0.2);
  const auto numbers = team.desk->hand_in("M", measurements(5), Time());
  team.run(30);
  team.station_receives = false;
  team.run(60);
  EXPECT_EQ(team.leads.at(EntityId{0}).master, EntityId{0}) << team.story();
  team.station_receives = true;
  team.out_of_reach = {1};
  team.run(120);
  EXPECT_EQ(team.masters(), std::set<std::uint32_t>{1}) << team.story();
  EXPECT_EQ(team.leads.at(EntityId{0}).master, EntityId{1}) << team.story();
  for (const std::uint32_t task : numbers)
    EXPECT_TRUE(team.desk->is_done(task)) << task << "\n" << team.story();
}

TEST(TeamOnAir, TasksThatReachedNobodyAreThereWhenTheStationLeadsAgain) {
  AirTeam team = three(TeamStructure::kMaster, 0);
  team.desk->hand_in("M", measurements(1), Time());
  team.run(60);
  team.aircraft.clear();
  team.desk->hand_in("M", measurements(2), Time::from_seconds(team.now));
  team.run(90);
  team.add(7, {0, 100});
  OnboardTeam& newcomer = *team.aircraft.at(EntityId{7}).team;
  team.aircraft.at(EntityId{7}).work.leaves = true;  // so that the station leads on
  team.run(60);
  EXPECT_EQ(team.masters(), std::set<std::uint32_t>{0}) << team.story();
  EXPECT_EQ(newcomer.member().knowledge().tasks.size(), 3u) << team.story();
}

WantedTask after(const Vec2& place, std::vector<std::uint32_t> before) {
  return {Measure{place, 30}, 0, false, std::move(before)};
}

std::string obey(AirTeam& team, const TeamTaskCommand& command) {
  AgentOutput out;
  const std::string why =
      team.desk->obey(command, command.what, out, Time::from_seconds(team.now));
  team.events.insert(team.events.end(), out.events.begin(), out.events.end());
  return why;
}

TEST(TeamOnAir, WhatComesAfterOthersIsFlownWhenTheyAreDone) {
  AirTeam team = three(TeamStructure::kMaster, 0.2);
  team.desk->hand_in("M", std::vector{after({0, 500}, {}), after({300, 500}, {1})},
                     Time());
  team.run(30);
  EXPECT_EQ(team.flown(), (std::multiset<std::uint32_t>{1})) << team.story();
  team.run(40);
  EXPECT_EQ(team.executed, (std::map<std::uint32_t, int>{{1, 1}})) << team.story();
  EXPECT_EQ(team.flown(), (std::multiset<std::uint32_t>{2})) << team.story();
  team.run(60);
  EXPECT_EQ(team.executed, (std::map<std::uint32_t, int>{{1, 1}, {2, 1}}));
  for (const auto& [number, states] : team.states) {
    EXPECT_EQ(states.front(), number == 1 ? "open" : "waits");
    EXPECT_GE(std::ranges::count(states, "flown"), 1) << number;
    EXPECT_EQ(states.back(), "done");
  }
}

TEST(TeamOnAir, WhatTheOperatorWithdrawsIsNotFlownAnyMore) {
  for (const auto structure :
       {TeamStructure::kMaster, TeamStructure::kFixedMaster, TeamStructure::kAuction}) {
    AirTeam team = three(structure, 0.2);
    const auto numbers = team.desk->hand_in("M", measurements(2), Time());
    team.task_time = 1e6;
    team.run(60);
    ASSERT_EQ(team.flown(), (std::multiset<std::uint32_t>{1, 2})) << team.story();
    EXPECT_EQ(obey(team, {TeamTaskAction::kWithdraw, 1}), "");
    EXPECT_EQ(team.count(EventKind::kTeamTaskWithdrawn), 1);
    EXPECT_TRUE(team.desk->is_done(numbers.front()));
    team.run(20);
    EXPECT_EQ(team.flown(), std::multiset<std::uint32_t>{2}) << team.story();
    EXPECT_NE(obey(team, {TeamTaskAction::kWithdraw, 1}), "") << "it is over";
    EXPECT_NE(obey(team, {TeamTaskAction::kWithdraw, 7}), "") << "there is none";
  }
}

TEST(TeamOnAir, WhatIsWithdrawnOutOfReachIsSaidWhenTheTeamIsBack) {
  AirTeam team = three(TeamStructure::kMaster, 0.1);
  team.desk->hand_in("M", measurements(2), Time());
  team.task_time = 1e6;
  team.run(60);
  team.station_receives = false;
  team.run(40);
  EXPECT_EQ(obey(team, {TeamTaskAction::kWithdraw, 2}), "");
  team.run(40);
  EXPECT_EQ(team.flown(), (std::multiset<std::uint32_t>{1, 2})) << team.story();
  team.station_receives = true;
  team.run(60);
  EXPECT_EQ(team.flown(), std::multiset<std::uint32_t>{1}) << team.story();
}

TEST(TeamOnAir, WhatIsChangedIsFlownInsteadAndWhatWaitsForItWaits) {
  AirTeam team = three(TeamStructure::kMaster, 0.2);
  const auto numbers = team.desk->hand_in(
      "M", std::vector{after({0, 500}, {}), after({300, 500}, {1}), after({0, 0}, {2})},
      Time());
  team.task_time = 60;
  team.run(40);
  ASSERT_EQ(team.flown(), (std::multiset<std::uint32_t>{1})) << team.story();
  EXPECT_EQ(obey(team, {TeamTaskAction::kChange, 1, Measure{{600, 600}, 30}}), "");
  EXPECT_EQ(team.count(EventKind::kTeamTaskAdded), 3) << "itself, and what waits for it";
  team.run(20);
  // Numbers 4, 5 and 6 are in the places of 1, 2 and 3.
  EXPECT_EQ(team.flown(), (std::multiset<std::uint32_t>{4})) << team.story();
  EXPECT_FALSE(team.desk->is_done(numbers.front()));
  team.run(300);
  EXPECT_EQ(team.executed, (std::map<std::uint32_t, int>{{4, 1}, {5, 1}, {6, 1}}))
      << team.story();
  for (const std::uint32_t number : numbers) EXPECT_TRUE(team.desk->is_done(number));
}

TEST(TeamOnAir, ATaskIsAddedByCommand) {
  AirTeam team = three(TeamStructure::kMaster, 0.2);
  team.desk->hand_in("M", measurements(1), Time());
  team.task_time = 1e6;
  team.run(60);
  EXPECT_NE(obey(team, {TeamTaskAction::kAdd, 0, Measure{{0, 0}, 9}, {}, {5}}), "");
  EXPECT_EQ(obey(team, {TeamTaskAction::kAdd, 0, Measure{{0, 0}, 9}}), "");
  // Before the leader has it: it is withdrawn again, and never flown.
  EXPECT_EQ(obey(team, {TeamTaskAction::kAdd, 0, Measure{{0, 0}, 9}}), "");
  EXPECT_EQ(obey(team, {TeamTaskAction::kWithdraw, 3}), "");
  team.run(30);
  EXPECT_EQ(team.flown(), (std::multiset<std::uint32_t>{1, 2})) << team.story();
}

TEST(TeamOnAir, WhatIsWithdrawnOnItsWayIsNotFlown) {
  for (const double later : {0.5, 1.0, 1.5, 2.0, 3.0})
    for (const double loss : {0.0, 0.3}) {
      AirTeam team = three(TeamStructure::kMaster, loss);
      team.desk->hand_in("M", measurements(1), Time());
      team.task_time = 1e6;
      team.run(60);
      EXPECT_EQ(obey(team, {TeamTaskAction::kAdd, 0, Measure{{0, 0}, 9}}), "");
      team.run(later);
      EXPECT_EQ(obey(team, {TeamTaskAction::kWithdraw, 2}), "");
      team.run(40);
      EXPECT_EQ(team.flown(), std::multiset<std::uint32_t>{1})
          << later << " s, " << loss << '\n'
          << team.story();
    }
}

TEST(TeamOnAir, WhatWaitsIsReplacedOnceHoweverItHangsTogether) {
  AirTeam team = three(TeamStructure::kMaster, 0);
  std::vector<WantedTask> tasks = {after({0, 500}, {})};
  for (std::uint32_t row = 0; row < 8; ++row) {
    const auto before = row == 0 ? std::vector<std::uint32_t>{1}
                                 : std::vector<std::uint32_t>{2 * row, 2 * row + 1};
    tasks.push_back(after({0, 0}, before));
    tasks.push_back(after({100, 0}, before));
  }
  team.desk->hand_in("M", tasks, Time());
  team.task_time = 1e6;
  team.run(60);
  EXPECT_EQ(obey(team, {TeamTaskAction::kChange, 1, Measure{{0, 300}, 30}}), "");
  EXPECT_EQ(team.count(EventKind::kTeamTaskAdded), 17);
  EXPECT_EQ(team.count(EventKind::kTeamTaskWithdrawn), 17);
}

TEST(TeamOnAir, WhatIsAddedLaterWaitsForWhatIsInThePlaceOfTheOld) {
  AirTeam team = three(TeamStructure::kMaster, 0);
  team.desk->hand_in("M", measurements(1), Time());
  team.task_time = 100;
  team.run(40);
  EXPECT_EQ(obey(team, {TeamTaskAction::kChange, 1, Measure{{0, 300}, 30}}), "");
  team.desk->hand_in("M", std::vector{after({0, 0}, {1})}, Time::from_seconds(team.now));
  EXPECT_EQ(obey(team, {TeamTaskAction::kAdd, 0, Measure{{9, 0}, 30}, {}, {1}}), "");
  team.run(60);
  EXPECT_EQ(team.flown(), std::multiset<std::uint32_t>{2}) << team.story();
  team.run(100);
  EXPECT_EQ(team.flown(), (std::multiset<std::uint32_t>{3, 4})) << team.story();
}

TEST(TeamOnAir, WhatIsChangedTakesTheSensorsOfWhatItIsNow) {
  AirTeam team = three(TeamStructure::kMaster, 0);
  Orbit object;
  object.object = 0;
  team.desk->hand_in("M", std::vector<WantedTask>{{object}}, Time());
  team.task_time = 1e6;
  team.run(60);
  EXPECT_EQ(team.flown(), std::multiset<std::uint32_t>{}) << "nobody has a camera";
  EXPECT_EQ(obey(team, {TeamTaskAction::kChange, 1, Measure{{0, 300}, 30}}), "");
  team.run(30);
  EXPECT_EQ(team.flown(), std::multiset<std::uint32_t>{2}) << team.story();
}

TEST(TeamOnAir, WhatNobodyCanFlyHoldsUpNothingElse) {
  for (const auto sharing : {TaskSharing::kCoalitions, TaskSharing::kSequences}) {
    AirTeam team(TeamStructure::kMaster);
    team.sharing = sharing;
    team.loss = 0.2;
    team.restart();
    team.add(1, {0, 100});
    team.impossible = {1};
    team.desk->hand_in("M", measurements(4), Time());
    team.run(500);
    EXPECT_EQ(team.executed, (std::map<std::uint32_t, int>{{2, 1}, {3, 1}, {4, 1}}))
        << team.story();
  }
}

TEST(TeamOnAir, SequencesAreFlownInTheirOrderWithoutWaitingForOrders) {
  AirTeam team(TeamStructure::kMaster);
  team.sharing = TaskSharing::kSequences;
  team.loss = 0.3;
  team.restart();
  team.add(1, {0, 100});
  team.add(2, {3000, 100});
  std::vector<WantedTask> tasks;
  for (const double north : {0, 300, 600, 3000, 3300, 3600})
    tasks.push_back(after({north, 500}, {}));
  team.desk->hand_in("M", tasks, Time());
  team.run(30 + 3 * 40 + 20);
  EXPECT_EQ(team.executed.size(), 6u) << team.story();
  for (const auto& [task, times] : team.executed) EXPECT_EQ(times, 1) << task;
}

}  // namespace
}  // namespace skein::reasoning::team_on_air_test
