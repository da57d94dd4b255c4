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
  team.station_hears = false;
  team.aircraft.erase(EntityId{1});
  team.run(300);
  EXPECT_EQ(team.masters(), std::set<std::uint32_t>{2}) << team.story();
  EXPECT_EQ(team.executed.size(), 7u) << team.story();
  for (const auto& [task, times] : team.executed) EXPECT_LE(times, 2) << task;
  // In reach again the station follows, and hears what is done.
  team.station_hears = true;
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
    team.station_hears = true;
    team.run(60);
    EXPECT_EQ(team.masters(), std::set<std::uint32_t>{1}) << team.story();
    team.station_hears = false;
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
  team.station_hears = false;
  team.run(60);
  EXPECT_EQ(team.leads.at(EntityId{0}).master, EntityId{0}) << team.story();
  team.station_hears = true;
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

}  // namespace
}  // namespace skein::reasoning::team_on_air_test
