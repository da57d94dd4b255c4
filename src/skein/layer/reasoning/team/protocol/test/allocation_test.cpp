// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/allocation.h"

#include <gtest/gtest.h>

namespace skein::reasoning::allocation_test {
namespace {

TeamTask task(std::uint32_t number, double north, bool single = true) {
  TeamTask made;
  made.number = number;
  made.place = {north, 0};
  made.single = single;
  return made;
}
TeamWorker worker(std::uint32_t id, double north, std::vector<std::uint32_t> tasks = {}) {
  TeamWorker made{{id}, {}, std::move(tasks)};
  made.resources.place = {north, 0, 0};
  return made;
}
using Tasks = std::vector<std::uint32_t>;

TEST(TeamAllocation, GivesTheNearestAndKeepsWhatIsFlown) {
  const std::vector<TeamTask> tasks = {task(1, 0), task(2, 100), task(3, 200)};
  const std::vector<TeamWorker> workers = {worker(1, 190), worker(2, 90),
                                           worker(3, 0, {3}), worker(4, 0)};
  auto given = allocate_nearest(tasks, workers);
  EXPECT_EQ(given[{3}], Tasks{3}) << "it flies it already";
  EXPECT_EQ(given[{2}], Tasks{2});
  EXPECT_EQ(given[{4}], Tasks{1});
  EXPECT_EQ(given[{1}], Tasks{}) << "there is none left";
}

TEST(TeamAllocation, LeavesADoubleToTheLowerId) {
  const std::vector<TeamTask> tasks = {task(1, 0)};
  const std::vector<TeamWorker> workers = {worker(4, 0, {1}), worker(9, 0, {1})};
  auto given = allocate_nearest(tasks, workers);
  EXPECT_EQ(given[{4}], Tasks{1});
  EXPECT_EQ(given[{9}], Tasks{});
}

TEST(TeamAllocation, SendsWhoIsLeftToGroupTasks) {
  const std::vector<TeamTask> tasks = {task(1, 0), task(2, 50, false)};
  const std::vector<TeamWorker> workers = {worker(1, 0), worker(2, 50), worker(3, 900)};
  auto given = allocate_nearest(tasks, workers);
  EXPECT_EQ(given[{1}], Tasks{1});
  EXPECT_EQ(given[{2}], Tasks{2});
  EXPECT_EQ(given[{3}], Tasks{2});
}

TEST(TeamAllocation, DividesByTheSizesOfTeams) {
  std::vector<TeamTask> tasks;
  for (std::uint32_t k = 1; k <= 9; ++k) tasks.push_back(task(k, 0));
  const std::vector<TeamWorker> first = {worker(1, 0, {9}), worker(2, 0)};
  const std::vector<TeamWorker> second = {worker(5, 0, {1})};
  const auto given = divide_by_size(tasks, first, second);
  EXPECT_TRUE(given.contains(9));
  EXPECT_FALSE(given.contains(1));
  EXPECT_EQ(given.size(), 6u);
}

}  // namespace
}  // namespace skein::reasoning::allocation_test
