// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/onboard/sequence_allocation.h"

#include <gtest/gtest.h>

#include <set>

#include "skein/base/random.h"
#include "skein/layer/reasoning/team/onboard/test/workers.h"

namespace skein::reasoning::sequence_allocation_test {
namespace {

using Numbers = std::vector<std::uint32_t>;

// The time until the last is done, of what is given; each task once.
double last_end(const TeamAllocation& given, const std::vector<TeamTask>& tasks,
                const std::vector<TeamWorker>& workers) {
  double last = 0;
  for (const TeamWorker& each : workers) {
    double time = 0;
    Vec2 at = geo::horizontal(each.resources.place);
    for (const std::uint32_t number : given.at(each.id)) {
      const TaskNeeds needs =
          needs_of(*std::ranges::find(tasks, number, &TeamTask::number));
      time += (*needs.begin - at).norm() / each.resources.speed + needs.stay;
      at = *needs.begin;
    }
    last = std::max(last, time);
  }
  return last;
}

TEST(SequenceAllocation, EachFliesItsOwnSideInOrder) {
  const FlightConditions conditions;
  SequenceAllocation allocate(conditions);
  const std::vector<TeamTask> tasks = {measure(1, {3000, 0}), measure(2, {1000, 0}),
                                       measure(3, {-1000, 0}), measure(4, {2000, 0}),
                                       measure(5, {-2500, 0})};
  const std::vector<TeamWorker> workers = {worker(1, {-100, 0}), worker(2, {100, 0})};
  const TeamAllocated found = allocate(tasks, workers);
  EXPECT_EQ(found.given.at(EntityId{1}), (Numbers{3, 5}));
  EXPECT_EQ(found.given.at(EntityId{2}), (Numbers{2, 4, 1}));
  EXPECT_NEAR(*found.value, -(2900.0 / 20 + 3 * 30), 1e-9);
  EXPECT_DOUBLE_EQ(*found.value, *found.bound) << "proven for so few";
}

TEST(SequenceAllocation, SaysTheTimeThatItTakes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, 0, Purpose::kTest);
    const FlightConditions conditions;
    SequenceAllocation allocate(conditions);
    std::vector<TeamTask> tasks;
    for (std::uint32_t k = 1; k <= 7; ++k)
      tasks.push_back(measure(
          k, {random.uniform(-3000, 3000), random.uniform(-3000, 3000)}, 20.0 * k));
    const std::vector<TeamWorker> workers = {worker(1, {0, 0}), worker(2, {500, 0}),
                                             worker(3, {0, 500})};
    const TeamAllocated found = allocate(tasks, workers);
    EXPECT_NEAR(last_end(found.given, tasks, workers), -*found.value, 1e-6) << seed;
    std::multiset<std::uint32_t> flown;
    for (const auto& [id, own] : found.given) flown.insert(own.begin(), own.end());
    EXPECT_EQ(flown, (std::multiset<std::uint32_t>{1, 2, 3, 4, 5, 6, 7})) << seed;
  }
}

TEST(SequenceAllocation, HundredsOfTasksAreSharedInEvenParts) {
  RandomStream random(3, 0, Purpose::kTest);
  const FlightConditions conditions;
  SequenceAllocation allocate(conditions);
  std::vector<TeamTask> tasks;
  for (std::uint32_t k = 1; k <= 200; ++k)
    tasks.push_back(
        measure(k, {random.uniform(-5000, 5000), random.uniform(-5000, 5000)}, 10));
  std::vector<TeamWorker> workers;
  for (std::uint32_t id = 1; id <= 10; ++id)
    workers.push_back(worker(id, {100.0 * id, 0}));
  const TeamAllocated found = allocate(tasks, workers);
  std::set<std::uint32_t> given;
  for (const auto& [id, own] : found.given) {
    EXPECT_GT(own.size(), 10u);
    given.insert(own.begin(), own.end());
    EXPECT_EQ(orderable(own, tasks).size(), kMaxOrdered);
  }
  EXPECT_EQ(given.size(), 200u);
  EXPECT_GE(*found.bound, *found.value);
  // 20 tasks of 10 s each at least, and some 500 m between neighbours.
  EXPECT_LT(-*found.value, 20 * (10 + 45));
}

TEST(SequenceAllocation, WhatComesAfterOthersIsOrderedWhenTheyAreOverOrFlownBefore) {
  const FlightConditions conditions;
  SequenceAllocation allocate(conditions);
  std::vector<TeamTask> tasks = {measure(1, {2000, 0}), measure(2, {100, 0}),
                                 measure(3, {-500, 0})};
  tasks[1].after = {1};
  std::vector<TeamWorker> workers = {worker(1, {0, 0})};
  const Numbers alone = allocate(tasks, workers).given.at(EntityId{1});
  EXPECT_EQ(orderable(alone, tasks).size(), 3u);
  EXPECT_LT(std::ranges::find(alone, 1u), std::ranges::find(alone, 2u));
  // Two: who has 1 is 2 km away, the other one must not begin with 2.
  workers.push_back(worker(2, {-400, 0}));
  SequenceAllocation two(conditions);
  std::size_t given = 0;
  for (const auto& [id, own] : two(tasks, workers).given) {
    given += own.size();
    const Numbers ordered = orderable(own, tasks);
    const auto second = std::ranges::find(ordered, 2u);
    if (second != ordered.end()) {
      EXPECT_LT(std::ranges::find(ordered, 1u), second);
    }
  }
  EXPECT_EQ(given, 3u);
  // Of an unknown team's task nothing is planned, nor of tasks that wait for each other.
  for (const std::uint32_t before : {9U, 3U}) {
    tasks[1].after = {before};
    tasks[2].after = {2};
    for (const auto& [id, own] : two(tasks, workers).given) {
      EXPECT_EQ(std::ranges::find(own, 2u), own.end());
      EXPECT_EQ(std::ranges::find(own, 3u), own.end());
    }
    std::size_t first = 0;
    for (const auto& [id, own] : two(tasks, workers).given) first += own.size();
    EXPECT_EQ(first, 1u) << "task 1 has nothing to do with it";
  }
}

TEST(SequenceAllocation, WhatHasNoEndIsFlownLast) {
  const FlightConditions conditions;
  SequenceAllocation allocate(conditions);
  Orbit orbit;
  orbit.point = {200, 0};
  std::vector<TeamTask> tasks = {team_task(1, orbit, 0, false), measure(2, {3000, 0}),
                                 measure(3, {3000, 500})};
  std::vector<TeamWorker> workers = {worker(1, {0, 0})};
  const TeamAllocated found = allocate(tasks, workers);
  ASSERT_EQ(found.given.at(EntityId{1}).size(), 3u);
  EXPECT_EQ(found.given.at(EntityId{1}).back(), 1u);
  EXPECT_GT(*found.value, -300) << "the time of what has no end does not count";
  orbit.point = {-200, 0};
  tasks.push_back(team_task(4, orbit, 0, false));
  SequenceAllocation again(conditions);
  EXPECT_EQ(again(tasks, workers).given.at(EntityId{1}).size(), 3u) << "one such only";
}

TEST(SequenceAllocation, OneLongTaskDoesNotSpoilTheSharingOfTheOthers) {
  const FlightConditions conditions;
  SequenceAllocation allocate(conditions);
  std::vector<TeamTask> tasks = {measure(1, {0, 0}, 7200)};
  for (std::uint32_t k = 2; k <= 9; ++k)
    tasks.push_back(measure(k, {100.0 * k, 300}, 60));
  std::vector<TeamWorker> workers;
  for (std::uint32_t id = 1; id <= 5; ++id)
    workers.push_back(worker(id, {100.0 * id, 0}));
  for (const auto& [id, own] : allocate(tasks, workers).given)
    EXPECT_LE(own.size(), 2u) << id.value;
}

TEST(SequenceAllocation, WhoIsOnItsWayIsNotThereYet) {
  const FlightConditions conditions;
  SequenceAllocation allocate(conditions);
  const std::vector<TeamTask> tasks = {team_task(1, FlyTo{{10000, 0}}, 0, false),
                                       measure(2, {10000, 300}),
                                       measure(3, {10000, -300})};
  std::vector<TeamWorker> workers = {worker(1, {0, 0}), worker(2, {8000, 0})};
  workers[0].tasks = {1};
  workers[0].shares = {0.01};
  const TeamAllocated found = allocate(tasks, workers);
  EXPECT_NEAR(*found.value, -500, 1e-9) << "the way is 10 km, as its share is of it";
  EXPECT_EQ(found.given.at(EntityId{2}).size(), 2u);
}

TEST(SequenceAllocation, WhoIsSlowGetsWhatItsOwnTimeAllows) {
  const FlightConditions conditions;
  SequenceAllocation allocate(conditions);
  const auto line = [](std::uint32_t number, double east) {
    FollowLine what;
    for (int k = 0; k < 10; ++k) what.points.push_back({k % 2 == 0 ? 0 : 1000.0, east});
    return team_task(number, what, 0, false);
  };
  const std::vector<TeamTask> tasks = {line(1, 0), line(2, 100)};
  std::vector<TeamWorker> workers = {worker(1, {0, 0})};
  workers[0].resources.speed = 10;  // 900 s for each
  workers[0].resources.endurance = 2150;
  EXPECT_EQ(allocate(tasks, workers).given.at(EntityId{1}).size(), 1u);
  workers[0].resources.endurance = 2600;
  SequenceAllocation again(conditions);
  EXPECT_EQ(again(tasks, workers).given.at(EntityId{1}).size(), 2u);
}

TEST(SequenceAllocation, WhatOneHasRefusedAnotherGets) {
  const FlightConditions conditions;
  SequenceAllocation allocate(conditions);
  const std::vector<TeamTask> tasks = {measure(1, {0, 0}), measure(2, {500, 0})};
  std::vector<TeamWorker> workers = {worker(1, {0, 0}), worker(2, {3000, 0})};
  workers[0].resources.refused = {1};
  const TeamAllocation given = allocate(tasks, workers).given;
  EXPECT_EQ(given.at(EntityId{1}), Numbers{2});
  EXPECT_EQ(given.at(EntityId{2}), Numbers{1});
}

TEST(SequenceAllocation, WhoHasNothingLeftGetsOthersTasks) {
  const FlightConditions conditions;
  SequenceAllocation allocate(conditions);
  std::vector<TeamTask> tasks;
  for (std::uint32_t k = 1; k <= 60; ++k) tasks.push_back(measure(k, {50.0 * k, 0}));
  std::vector<TeamWorker> workers = {worker(1, {0, 0}), worker(2, {3000, 0})};
  const Numbers done = allocate(tasks, workers).given.at(EntityId{1});
  std::erase_if(tasks, [&](const TeamTask& task) {
    return std::ranges::find(done, task.number) != done.end();
  });
  EXPECT_GT(allocate(tasks, workers).given.at(EntityId{1}).size(), 5u);
}

TEST(SequenceAllocation, WhoHasBegunATaskEndsItFirst) {
  const FlightConditions conditions;
  SequenceAllocation allocate(conditions);
  const std::vector<TeamTask> tasks = {measure(1, {0, 0}, 1200), measure(2, {300, 0}),
                                       measure(3, {5000, 0})};
  std::vector<TeamWorker> workers = {worker(1, {0, 0}), worker(2, {4000, 0})};
  workers[0].tasks = {1};
  workers[0].shares = {0.5};
  const TeamAllocated found = allocate(tasks, workers);
  ASSERT_FALSE(found.given.at(EntityId{1}).empty());
  EXPECT_EQ(found.given.at(EntityId{1}).front(), 1u);
  EXPECT_EQ(found.given.at(EntityId{2}).size(), 2u) << "600 s are left of 1";
  EXPECT_NEAR(*found.value, -600, 1e-9);
}

TEST(SequenceAllocation, KeepsWhatIsHardlyWorse) {
  const FlightConditions conditions;
  SequenceAllocation allocate(conditions);
  const std::vector<TeamTask> tasks = {measure(1, {0, 1000}), measure(2, {0, -1000})};
  std::vector<TeamWorker> workers = {worker(1, {0, 10}), worker(2, {0, -10})};
  const TeamAllocation first = allocate(tasks, workers).given;
  ASSERT_EQ(first.at(EntityId{1}), Numbers{1});
  std::swap(workers[0].resources.place, workers[1].resources.place);
  EXPECT_EQ(allocate(tasks, workers).given, first);
  workers[0].resources.place.y() = -300;
  workers[1].resources.place.y() = 300;
  EXPECT_EQ(allocate(tasks, workers).given.at(EntityId{1}), Numbers{2});
}

TEST(SequenceAllocation, EnduranceAndSensorsSayHowMuch) {
  const FlightConditions conditions;
  SequenceAllocation allocate(conditions);
  const std::vector<TeamTask> tasks = {measure(1, {1000, 0}), measure(2, {2000, 0}),
                                       measure(3, {500, 0}, 30, kCameraSensor)};
  std::vector<TeamWorker> workers = {worker(1, {0, 0})};
  // There and home 100 s, two stays of 30 s, and a fifth more: 312 s.
  workers[0].resources.endurance = 320;
  EXPECT_EQ(allocate(tasks, workers).given.at(EntityId{1}), (Numbers{1, 2}));
  workers[0].resources.endurance = 300;
  SequenceAllocation weak(conditions);
  EXPECT_EQ(weak(tasks, workers).given.at(EntityId{1}), Numbers{1});
}

}  // namespace
}  // namespace skein::reasoning::sequence_allocation_test
