// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/coalitions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "skein/solve/allocation/coalition_annealing.h"
#include "skein/solve/allocation/coalition_pricing.h"
#include "skein/solve/allocation/coalition_proof.h"
#include "skein/solve/allocation/coalition_subsets.h"
#include "skein/solve/allocation/search_random.h"
#include "skein/solve/allocation/task_satisfaction.h"

namespace skein::solve::coalitions_test {
namespace {

constexpr std::size_t kIdle = CoalitionAnswer::kIdle;

CoalitionProblem random_coalitions(std::uint64_t seed, std::size_t aircraft,
                                   std::size_t tasks, bool idle_allowed) {
  SearchRandom random(seed, 7);
  CoalitionProblem problem;
  problem.aircraft = aircraft;
  problem.idle_allowed = idle_allowed;
  for (std::size_t k = 0; k < tasks; ++k) {
    CoalitionTask task;
    task.form = static_cast<Satisfaction>(random.below(3));
    for (std::size_t i = 0; i < aircraft; ++i) {
      task.brings.push_back(random.uniform() < 0.3 ? 0 : 1.2 * random.uniform());
      task.cost.push_back(0.6 * random.uniform());
    }
    problem.tasks.push_back(task);
  }
  return problem;
}

// All assignments, one by one.
double best_of_all(const CoalitionProblem& problem) {
  std::vector<std::size_t> task(problem.aircraft, 0);
  const std::size_t places = problem.tasks.size() + (problem.idle_allowed ? 1 : 0);
  double best = -1e9;
  for (;;) {
    std::vector<std::size_t> named = task;
    for (std::size_t& k : named)
      if (k == problem.tasks.size()) k = kIdle;
    best = std::max(best, utility_of(problem, named));
    std::size_t i = 0;
    while (i < task.size() && ++task[i] == places) task[i++] = 0;
    if (i == task.size()) return best;
  }
}

TEST(Coalitions, OfFewAircraftAreTheBestOfAllAssignments) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto problem =
        random_coalitions(seed, 1 + seed % 5, 1 + seed % 3, seed % 2 == 0);
    const CoalitionAnswer answer = best_coalitions(problem, {});
    EXPECT_TRUE(answer.quality.proven);
    EXPECT_NEAR(answer.quality.value, best_of_all(problem), 1e-12) << seed;
    EXPECT_NEAR(answer.quality.value, utility_of(problem, answer.task), 1e-12);
    if (!problem.idle_allowed) {
      EXPECT_EQ(std::count(answer.task.begin(), answer.task.end(), kIdle), 0);
    }
  }
}

TEST(Coalitions, BranchAndPriceProvesWhatSubsetsFind) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto problem = random_coalitions(seed, 9, 2 + seed % 4, seed % 2 == 0);
    CoalitionAnswer answer;
    answer.task = greedy_coalitions(problem);
    answer.quality.value = utility_of(problem, answer.task);
    Effort effort;
    effort.prove = true;
    bound_coalitions(problem, effort, answer);
    EXPECT_TRUE(answer.quality.proven) << seed;
    // 1e-7: what counts as equal in the proof.
    EXPECT_NEAR(answer.quality.value, best_coalitions_by_subsets(problem).quality.value,
                2e-7)
        << seed;
  }
}

TEST(Coalitions, OfManyAircraftAreBoundedAndNeverBelowGreedy) {
  for (const bool idle : {true, false}) {
    const auto problem = random_coalitions(5, 40, 12, idle);
    const CoalitionAnswer answer = best_coalitions(problem, {});
    EXPECT_GE(answer.quality.value, utility_of(problem, greedy_coalitions(problem)));
    EXPECT_GE(answer.quality.bound, answer.quality.value);
    EXPECT_LT(answer.quality.gap(), 0.01);
    const CoalitionAnswer again = best_coalitions(problem, {});
    EXPECT_EQ(again.task, answer.task);
  }
}

TEST(Coalitions, WithoutTimeAreStillGreedyOrBetterAndBounded) {
  const auto problem = random_coalitions(6, 40, 12, true);
  Effort effort;
  effort.used = [] { return 2.0; };
  const CoalitionAnswer answer = best_coalitions(problem, effort);
  EXPECT_GE(answer.quality.value, utility_of(problem, greedy_coalitions(problem)));
  EXPECT_GE(answer.quality.bound, answer.quality.value);
}

TEST(Coalitions, OfNobodyOrNothingAreEmpty) {
  CoalitionProblem problem;
  EXPECT_TRUE(best_coalitions(problem, {}).quality.proven);
  problem.aircraft = 20;
  const CoalitionAnswer answer = best_coalitions(problem, {});
  EXPECT_EQ(answer.quality.value, 0);
  EXPECT_EQ(std::count(answer.task.begin(), answer.task.end(), kIdle), 20);
}

TEST(Pricing, FindsTheGroupWorthMostUnderAnyPrices) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const auto problem = random_coalitions(seed, 8, 1, true);
    SearchRandom random(seed, 9);
    std::vector<double> price;
    std::vector<Membership> membership;
    for (int i = 0; i < 8; ++i) {
      price.push_back(0.5 * random.uniform() - 0.2);
      const double draw = random.uniform();
      membership.push_back(draw < 0.1   ? Membership::kMust
                           : draw < 0.2 ? Membership::kNever
                                        : Membership::kFree);
    }
    const auto worth = [&](const auto& members) {
      const std::vector<std::size_t> group(members.begin(), members.end());
      double w = satisfaction_of(problem.tasks[0], group);
      for (const std::size_t i : group) w -= problem.tasks[0].cost[i] + price[i];
      return w;
    };
    double best = -1e9;
    for (unsigned mask = 0; mask < 256; ++mask) {
      std::vector<std::size_t> group;
      bool allowed = true;
      for (std::size_t i = 0; i < 8; ++i) {
        if (mask >> i & 1) group.push_back(i);
        allowed = allowed && membership[i] != ((mask >> i & 1) ? Membership::kNever
                                                               : Membership::kMust);
      }
      if (allowed) best = std::max(best, worth(group));
    }
    const PricedGroup found = best_group(problem.tasks[0], price, membership);
    EXPECT_NEAR(found.worth, best, 1e-12) << seed;
    EXPECT_NEAR(worth(found.members), best, 1e-12) << seed;
    EXPECT_GE(found.bound, found.worth);
  }
}

TeamAircraft some_aircraft() {
  TeamAircraft aircraft;
  aircraft.v_min = 12;
  aircraft.v_max = 25;
  aircraft.cruise = 20;
  aircraft.turn_radius = 50;
  aircraft.endurance = 1000;
  aircraft.sensors["camera"] = {100, 0.8};
  aircraft.relay_quality = 0.9;
  return aircraft;
}

// The satisfaction of a task by so many equal aircraft.
double satisfied(const TeamTask& task, std::size_t count) {
  const std::vector<TeamAircraft> team(count, some_aircraft());
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back(i);
  return satisfaction_of(satisfaction_row(task, team), all);
}

TEST(TaskSatisfaction, IsThatOfTheKindOfTask) {
  TeamTask task;
  task.what = SurveillanceTask{"camera", 1.6e6};  // one covers 0.8 100 20 1000
  EXPECT_NEAR(satisfied(task, 1), 1, 1e-12);
  EXPECT_NEAR(satisfied(task, 4), 2, 1e-12);
  task.what = SurveillanceTask{"camera", 1.7e6};
  EXPECT_EQ(satisfied(task, 1), 0);
  task.what = SurveillanceTask{"thermal", 1};
  EXPECT_EQ(satisfied(task, 3), 0);
  task.what = TrackingTask{"camera", 15};
  EXPECT_NEAR(satisfied(task, 1), 2 * 0.8 / 1.5, 1e-12);
  EXPECT_NEAR(satisfied(task, 3), 2 * 0.8 / 1.5, 1e-12);
  task.what = TrackingTask{"camera", 2};
  EXPECT_NEAR(satisfied(task, 1), 2 * 0.8 * std::exp(-1.0) / 1.5, 1e-12);
  task.what = TrackingTask{"camera", 26};
  EXPECT_EQ(satisfied(task, 1), 0);
  task.what = PatrolTask{4000, 200, false};
  EXPECT_EQ(satisfied(task, 1), 0);
  EXPECT_NEAR(satisfied(task, 2), 1, 1e-12);
  task.what = PatrolTask{4000, 200, true};
  EXPECT_NEAR(satisfied(task, 1), 1, 1e-12);
  task.what = RouteTask{10000};  // 500 s of 1000 / 1.2
  EXPECT_NEAR(satisfied(task, 1), 1.5, 1e-12);
  task.what = RouteTask{14000};
  EXPECT_NEAR(satisfied(task, 1), 1000 / (1.2 * 700), 1e-12);
  task.what = RouteTask{20000};
  EXPECT_EQ(satisfied(task, 1), 0);
  task.what = GuardTask{"camera", 3};
  EXPECT_EQ(satisfied(task, 2), 0);
  EXPECT_NEAR(satisfied(task, 3), 1, 1e-12);
  EXPECT_NEAR(satisfied(task, 12), 2, 1e-12);
  task.what = RelayTask{{0, 0}, {1600, 0}, 1000};
  EXPECT_NEAR(satisfied(task, 2), 0.9, 1e-12);
  task.what = RelayTask{{0, 0}, {1601, 0}, 1000};
  EXPECT_EQ(satisfied(task, 2), 0);
  task.what = ShareTask{{0.3, 0.4}};
  EXPECT_NEAR(satisfied(task, 2), 0.7, 1e-12);
}

TEST(Allocation, ChangesOnlyForMoreThanFivePercent) {
  EXPECT_FALSE(is_worth_changing(10, 10.5, false));
  EXPECT_TRUE(is_worth_changing(10, 10.51, false));
  EXPECT_TRUE(is_worth_changing(10, 10.01, true));
  EXPECT_FALSE(is_worth_changing(10, 10, true));
  EXPECT_TRUE(is_worth_changing(-10, -9.4, false));
  EXPECT_TRUE(is_worth_changing(0, 0.1, false));
}

}  // namespace
}  // namespace skein::solve::coalitions_test
