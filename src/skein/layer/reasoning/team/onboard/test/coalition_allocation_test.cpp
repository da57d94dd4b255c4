// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/onboard/coalition_allocation.h"

#include <gtest/gtest.h>

#include "skein/layer/reasoning/team/onboard/test/workers.h"

namespace skein::reasoning::coalition_allocation_test {
namespace {

FlightConditions in_wind(const Vec2& wind) {
  FlightConditions conditions;
  conditions.set_wind(wind);
  return conditions;
}

using Numbers = std::vector<std::uint32_t>;

TEST(CoalitionAllocation, SharesForTheSumAndNotForTheNearest) {
  const FlightConditions conditions = in_wind({0, 0});
  CoalitionAllocation allocate(conditions);
  // The nearest pair is 2 and task 1: then 1 would have to fly 2100 m.
  const std::vector<TeamTask> tasks = {measure(1, {1000, 0}), measure(2, {2100, 0})};
  const std::vector<TeamWorker> workers = {worker(1, {0, 0}), worker(2, {1500, 0})};
  const TeamAllocation given = allocate(tasks, workers).given;
  EXPECT_EQ(given.at(EntityId{1}), Numbers{1});
  EXPECT_EQ(given.at(EntityId{2}), Numbers{2});
}

TEST(CoalitionAllocation, TheWindDecidesWhoIsNear) {
  const std::vector<TeamTask> tasks = {measure(1, {0, 0})};
  const std::vector<TeamWorker> workers = {worker(1, {-1200, 0}), worker(2, {1000, 0})};
  const FlightConditions none = in_wind({0, 0}), wind = in_wind({10, 0});
  CoalitionAllocation calm(none), windy(wind);
  EXPECT_EQ(calm(tasks, workers).given.at(EntityId{2}), Numbers{1});
  EXPECT_EQ(windy(tasks, workers).given.at(EntityId{1}), Numbers{1});
}

TEST(CoalitionAllocation, SensorsAndEnduranceSayWhoIsAble) {
  const FlightConditions conditions = in_wind({0, 0});
  CoalitionAllocation allocate(conditions);
  std::vector<TeamTask> tasks = {team_task(1, Measure{{0, 0}, 30}, kCameraSensor, false)};
  std::vector<TeamWorker> workers = {worker(1, {0, 0}),
                                     worker(2, {3000, 0}, kCameraSensor)};
  EXPECT_EQ(allocate(tasks, workers).given.at(EntityId{2}), Numbers{1});
  workers[1].resources.endurance = 210;  // 216 s there, for the task, home, and more
  EXPECT_TRUE(allocate(tasks, workers).given.at(EntityId{2}).empty());
  EXPECT_TRUE(allocate(tasks, workers).given.at(EntityId{1}).empty());
}

TEST(CoalitionAllocation, ChangesOnlyForMoreThanFivePercent) {
  const FlightConditions conditions = in_wind({0, 0});
  CoalitionAllocation allocate(conditions);
  const std::vector<TeamTask> tasks = {measure(1, {0, 0})};
  std::vector<TeamWorker> workers = {worker(1, {1000, 0}), worker(2, {1000, 10})};
  ASSERT_EQ(allocate(tasks, workers).given.at(EntityId{1}), Numbers{1});
  workers[0].tasks = {1};
  workers[1].resources.place = {960, 0, -100};
  EXPECT_EQ(allocate(tasks, workers).given.at(EntityId{1}), Numbers{1});
  workers[1].resources.place = {100, 0, -100};
  EXPECT_EQ(allocate(tasks, workers).given.at(EntityId{2}), Numbers{1});
}

TEST(CoalitionAllocation, WhoHasBegunWithATaskKeepsItWhereverThatLeads) {
  const FlightConditions conditions = in_wind({0, 0});
  CoalitionAllocation allocate(conditions);
  Survey survey;
  survey.area = {{0, 0}, {2000, 0}, {2000, 500}, {0, 500}};
  const std::vector<TeamTask> tasks = {team_task(1, survey, 0, false)};
  std::vector<TeamWorker> workers = {worker(1, {0, 0}), worker(2, {-500, 0})};
  ASSERT_EQ(allocate(tasks, workers).given.at(EntityId{1}), Numbers{1});
  workers[0].tasks = {1};
  workers[0].shares = {0};
  ASSERT_EQ(allocate(tasks, workers).given.at(EntityId{1}), Numbers{1});
  // Along the first line of the survey, of which nothing is seen yet in whole.
  workers[0].resources.place = {1900, 0, -100};
  EXPECT_EQ(allocate(tasks, workers).given.at(EntityId{1}), Numbers{1});
  workers[0].shares = {0.4};
  workers[1].resources.place = {0, 0, -100};
  EXPECT_EQ(allocate(tasks, workers).given.at(EntityId{1}), Numbers{1});
}

TEST(CoalitionAllocation, TheWayHomeCounts) {
  const FlightConditions conditions = in_wind({0, 0});
  CoalitionAllocation allocate(conditions);
  const std::vector<TeamTask> tasks = {measure(1, {0, 0})};
  std::vector<TeamWorker> workers = {worker(1, {0, 0})};
  workers[0].resources.endurance = 300;
  workers[0].resources.home_north = 4000;  // 200 s
  EXPECT_EQ(allocate(tasks, workers).given.at(EntityId{1}), Numbers{1});
  workers[0].resources.home_north = 5000;
  EXPECT_TRUE(allocate(tasks, workers).given.at(EntityId{1}).empty());
}

TEST(CoalitionAllocation, ZonesDecideWhoIsNear) {
  Zone wall;
  wall.area = geo::Ring{{400, -3000}, {600, -3000}, {600, 3000}, {400, 3000}};
  FlightConditions conditions;
  CoalitionAllocation allocate(conditions);
  const std::vector<TeamTask> tasks = {measure(1, {0, 0})};
  const std::vector<TeamWorker> workers = {worker(1, {1000, 0}), worker(2, {-2000, 0})};
  EXPECT_EQ(allocate(tasks, workers).given.at(EntityId{1}), Numbers{1});
  conditions.set_zones({&wall, 1}, 100, 0);
  EXPECT_EQ(allocate(tasks, workers).given.at(EntityId{2}), Numbers{1});
}

TEST(CoalitionAllocation, WhatComesAfterAnotherTaskWaits) {
  const FlightConditions conditions = in_wind({0, 0});
  CoalitionAllocation allocate(conditions);
  std::vector<TeamTask> tasks = {measure(1, {2000, 0}), measure(2, {0, 0})};
  tasks[1].after = {1};
  const std::vector<TeamWorker> workers = {worker(1, {0, 0}), worker(2, {0, 100})};
  const TeamAllocation given = allocate(tasks, workers).given;
  EXPECT_EQ(given.at(EntityId{1}).size() + given.at(EntityId{2}).size(), 1u);
  for (const auto& [id, own] : given) EXPECT_TRUE(own.empty() || own == Numbers{1});
}

TEST(CoalitionAllocation, NoSingleTaskHasTwo) {
  const FlightConditions conditions = in_wind({3, -2});
  CoalitionAllocation allocate(conditions);
  std::vector<TeamTask> tasks = {measure(1, {0, 0}), measure(2, {0, 0})};
  std::vector<TeamWorker> workers;
  for (std::uint32_t id = 1; id <= 6; ++id) workers.push_back(worker(id, {0, 0}));
  workers[2].tasks = workers[3].tasks = {2};
  std::map<std::uint32_t, int> flown;
  for (const auto& [id, numbers] : allocate(tasks, workers).given)
    for (const std::uint32_t number : numbers) ++flown[number];
  EXPECT_EQ(flown, (std::map<std::uint32_t, int>{{1, 1}, {2, 1}}));
  tasks[1].single = false;
  flown.clear();
  for (const auto& [id, numbers] : allocate(tasks, workers).given)
    for (const std::uint32_t number : numbers) ++flown[number];
  EXPECT_GT(flown[2], 1);
}

TEST(WorthOf, FallsWithTheTimeFromTheEndOfTheBundle) {
  const TeamTask near = measure(1, {500, 0}), far = measure(2, {3000, 0});
  const TeamResources self = worker(1, {0, 0}).resources;
  EXPECT_GT(worth_of(near, self, {}, in_wind({0, 0})),
            worth_of(far, self, {}, in_wind({0, 0})));
  const std::vector<TeamTask> bundle = {far};
  EXPECT_LT(worth_of(near, self, bundle, in_wind({0, 0})),
            worth_of(near, self, {}, in_wind({0, 0})));
  EXPECT_EQ(worth_of(near, self, {}, in_wind({-25, 0})), 0);
}

TEST(CoalitionAllocation, WhoWaitsForItsOrderKeepsWhatItWasGiven) {
  const FlightConditions conditions = in_wind({0, 0});
  CoalitionAllocation allocate(conditions);
  std::vector<TeamTask> tasks = {measure(1, {0, 0}), measure(2, {0, 0})};
  tasks[1].single = false;
  std::vector<TeamWorker> workers = {worker(1, {0, 0}), worker(2, {2000, 0})};
  workers[0].tasks = {1};
  ASSERT_EQ(allocate(tasks, workers).given.at(EntityId{2}), Numbers{2});
  EXPECT_EQ(allocate(tasks, workers).given.at(EntityId{2}), Numbers{2})
      << "worth less than 5 % of all";
}

}  // namespace
}  // namespace skein::reasoning::coalition_allocation_test
