#include "skein/layer/reasoning/team/onboard/sequence_allocation.h"

#include <gtest/gtest.h>

#include "skein/base/random.h"
#include "skein/layer/reasoning/team/onboard/task_needs.h"

namespace skein::reasoning::sequence_allocation_test {
namespace {

using Numbers = std::vector<std::uint32_t>;

TeamWorker worker(std::uint32_t id, const Vec2& place, std::uint32_t sensors = 0) {
  TeamWorker made;
  made.id = EntityId{id};
  made.resources.place = {place.x(), place.y(), -100};
  made.resources.speed = 20;
  made.resources.endurance = 36000;
  made.resources.sensors = sensors;
  return made;
}

TeamTask measure(std::uint32_t number, const Vec2& place, double stay = 30,
                 std::uint32_t sensors = 0) {
  return team_task(number, Measure{place, stay}, sensors, false);
}

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
  for (const auto& [id, own] : found.given)
    EXPECT_EQ(own.size(), SequenceAllocation::kMaxGiven);
  EXPECT_GE(*found.bound, *found.value);
  // 20 tasks of 10 s each at least, and some 500 m between neighbours.
  EXPECT_LT(-*found.value, 20 * (10 + 45));
}

TEST(SequenceAllocation, WhatComesAfterOthersIsGivenWhenTheyAreOverOrFlownBefore) {
  const FlightConditions conditions;
  SequenceAllocation allocate(conditions);
  std::vector<TeamTask> tasks = {measure(1, {2000, 0}), measure(2, {100, 0}),
                                 measure(3, {-500, 0})};
  tasks[1].after = {1};
  std::vector<TeamWorker> workers = {worker(1, {0, 0})};
  EXPECT_EQ(allocate(tasks, workers).given.at(EntityId{1}).size(), 3u);
  const Numbers alone = allocate(tasks, workers).given.at(EntityId{1});
  EXPECT_LT(std::ranges::find(alone, 1u), std::ranges::find(alone, 2u));
  // Two: who has 1 is 2 km away, the other one must not begin with 2.
  workers.push_back(worker(2, {-400, 0}));
  SequenceAllocation two(conditions);
  for (const auto& [id, own] : two(tasks, workers).given) {
    const auto second = std::ranges::find(own, 2u);
    if (second != own.end()) {
      EXPECT_LT(std::ranges::find(own, 1u), second);
    }
  }
  // Of an unknown team's task nothing is planned.
  tasks[1].after = {9};
  for (const auto& [id, own] : two(tasks, workers).given)
    EXPECT_EQ(std::ranges::find(own, 2u), own.end());
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
