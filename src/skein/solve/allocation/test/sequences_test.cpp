// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/sequences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "skein/solve/allocation/search_random.h"
#include "skein/solve/allocation/sequence_annealing.h"
#include "skein/solve/allocation/sequence_orders.h"
#include "skein/solve/allocation/sequence_subsets.h"

namespace skein::solve::sequences_test {
namespace {

using Kind = TaskRelation::Kind;

// Flight times that no plane gives: there is another one than back.
SequenceProblem random_sequences(std::uint64_t seed, std::size_t aircraft,
                                 std::size_t tasks, SequenceObjective objective) {
  SearchRandom random(seed, 11);
  const auto times = std::make_shared<std::vector<double>>();
  for (std::size_t k = 0; k < aircraft * (tasks + 2) * (tasks + 2); ++k)
    times->push_back(10 + 90 * random.uniform());
  const auto time = [times, tasks](std::size_t a, std::size_t i, std::size_t j) {
    return (*times)[(a * (tasks + 2) + i) * (tasks + 2) + j];
  };
  SequenceProblem problem;
  problem.aircraft = aircraft;
  problem.objective = objective;
  problem.discount = 0.01;
  problem.from_start = [time](std::size_t a, std::size_t t) { return time(a, 0, t + 2); };
  problem.between = [time](std::size_t a, std::size_t s, std::size_t t) {
    return time(a, s + 2, t + 2);
  };
  problem.home = [time](std::size_t a, std::size_t t) { return time(a, t + 2, 1); };
  problem.returns = seed % 2 == 0;
  for (std::size_t t = 0; t < tasks; ++t) {
    SequenceTask task;
    task.service = 30 * random.uniform();
    task.value = 10 + 50 * random.uniform();
    if (random.uniform() < 0.4) {
      task.eligible.assign(aircraft, false);
      task.eligible[random.below(aircraft)] = true;
    }
    problem.tasks.push_back(task);
  }
  return problem;
}

// The least cost of all routes, or infinity; `table` of one selection.
double min_of_all(const SequenceTable& table, SequenceRoutes& routes, std::size_t t) {
  if (t == table.tasks) {
    const SequenceSchedule schedule = schedule_of(table, routes);
    return schedule.late > 0 ? INFINITY : cost_of(table, schedule);
  }
  double least = INFINITY;
  for (std::size_t a = 0; a < table.aircraft; ++a) {
    if (!table.may(a, t)) continue;
    for (std::size_t k = 0; k <= routes[a].size(); ++k) {
      routes[a].insert(routes[a].begin() + static_cast<std::ptrdiff_t>(k), t);
      least = std::min(least, min_of_all(table, routes, t + 1));
      routes[a].erase(routes[a].begin() + static_cast<std::ptrdiff_t>(k));
    }
  }
  return least;
}

double min_of_all(const SequenceProblem& problem) {
  const auto selections = SequenceSelections::of(problem);
  double least = INFINITY;
  for (std::size_t k = 0; k < selections.value().count(); ++k) {
    const SequenceTable table = selections.value().table(k);
    SequenceRoutes routes(table.aircraft);
    least = std::min(least, min_of_all(table, routes, 0));
  }
  return problem.objective == SequenceObjective::kDiscounted ? -least : least;
}

constexpr SequenceObjective kAll[] = {SequenceObjective::kLastEnd,
                                      SequenceObjective::kTotal,
                                      SequenceObjective::kDiscounted};

// Each task once, in a route of an aircraft that may, and the value that is said.
void expect_whole(const SequenceProblem& problem, const SequenceAnswer& answer) {
  std::set<std::size_t> done;
  for (std::size_t a = 0; a < problem.aircraft; ++a)
    for (const std::size_t t : answer.routes[a]) {
      EXPECT_TRUE(done.insert(t).second);
      EXPECT_TRUE(problem.tasks[t].eligible.empty() || problem.tasks[t].eligible[a]);
    }
  for (std::size_t t = 0; t < problem.tasks.size(); ++t)
    EXPECT_EQ(std::isnan(answer.begin[t]), !done.contains(t));
}

TEST(Sequences, OfFewTasksAreTheBestOfAll) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed)
    for (const SequenceObjective objective : kAll) {
      const auto problem = random_sequences(seed, 1 + seed % 3, 1 + seed % 5, objective);
      const auto answer = best_sequences(problem, {});
      ASSERT_TRUE(answer.ok()) << answer.error().text();
      EXPECT_TRUE(answer.value().quality.proven);
      EXPECT_NEAR(answer.value().quality.value, min_of_all(problem), 1e-9) << seed;
      expect_whole(problem, answer.value());
    }
}

TEST(Sequences, WithWindowsAreTheBestOfAllThatKeepThem) {
  int feasible = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed)
    for (const SequenceObjective objective : kAll) {
      auto problem = random_sequences(seed, 2, 5, objective);
      SearchRandom random(seed, 12);
      for (SequenceTask& task : problem.tasks) {
        task.opens = 150 * random.uniform();
        task.closes = task.opens + 120 * random.uniform();
      }
      const auto answer = best_sequences(problem, {});
      ASSERT_TRUE(answer.ok());
      const double best = min_of_all(problem);
      ASSERT_EQ(answer.value().feasible, std::isfinite(best)) << seed;
      if (!answer.value().feasible) continue;
      ++feasible;
      EXPECT_NEAR(answer.value().quality.value, best, 1e-9);
      EXPECT_TRUE(answer.value().quality.proven);
    }
  EXPECT_GT(feasible, 10);
}

TEST(Sequences, WithRelationsAreTheBestOfAllThatKeepThem) {
  int feasible = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed)
    for (const SequenceObjective objective : kAll) {
      auto problem = random_sequences(seed, 2 + seed % 2, 5, objective);
      for (SequenceTask& task : problem.tasks) task.eligible.clear();
      problem.relations = {
          {Kind::kBefore, 0, 1, 5}, {Kind::kAfter, 2, 1, 0}, {Kind::kTogether, 3, 4, 0}};
      if (seed % 3 == 0) problem.relations.push_back({Kind::kAt, 0, 0, 60});
      const auto answer = best_sequences(problem, {});
      ASSERT_TRUE(answer.ok());
      const double best = min_of_all(problem);
      ASSERT_EQ(answer.value().feasible, std::isfinite(best)) << seed;
      if (!answer.value().feasible) continue;
      ++feasible;
      EXPECT_TRUE(answer.value().quality.proven);
      EXPECT_NEAR(answer.value().quality.value, best, 1e-9) << seed;
      const auto& begin = answer.value().begin;
      EXPECT_GE(begin[1], begin[0] + problem.tasks[0].service + 5 - 1e-9);
      EXPECT_GE(begin[2], begin[1] + problem.tasks[1].service - 1e-9);
      EXPECT_NEAR(begin[3], begin[4], 1e-9);
    }
  EXPECT_GT(feasible, 30);
}

TEST(Sequences, ChooseTheBestAlternative) {
  using Order = TaskOrder::Kind;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    auto problem = random_sequences(seed, 2, 5, kAll[seed % 3]);
    const auto task = [](std::size_t t) { return TaskOrder{Order::kTask, t, {}}; };
    // 0, then either 1 or both 2 and 3 in any order; 4 in any case.
    problem.orders = {{Order::kSequence,
                       0,
                       {task(0),
                        {Order::kAlternative,
                         0,
                         {task(1), {Order::kParallel, 0, {task(2), task(3)}}}}}}};
    const auto answer = best_sequences(problem, {});
    ASSERT_TRUE(answer.ok()) << answer.error().text();
    EXPECT_NEAR(answer.value().quality.value, min_of_all(problem), 1e-9) << seed;
    const auto& begin = answer.value().begin;
    EXPECT_EQ(std::isnan(begin[1]), !std::isnan(begin[2]));
    EXPECT_EQ(std::isnan(begin[2]), std::isnan(begin[3]));
    EXPECT_FALSE(std::isnan(begin[0]) || std::isnan(begin[4]));
    expect_whole(problem, answer.value());
  }
}

TEST(Sequences, OfManyTasksReachWhatSubsetsProve) {
  for (const SequenceObjective objective : kAll) {
    const auto problem = random_sequences(3, 4, 12, objective);
    const SequenceTable table = SequenceSelections::of(problem).value().table(0);
    std::int64_t made = 0;
    const auto exact = best_by_subsets(table, made);
    ASSERT_TRUE(exact);
    const double best = cost_of(table, schedule_of(table, *exact));
    const auto found = anneal_sequences(table, {}, 300'000, made);
    const double cost = cost_of(table, schedule_of(table, found));
    EXPECT_GE(cost, best - 1e-9);
    EXPECT_LE(cost, best + 0.005 * std::abs(best));
    EXPECT_LE(cost_bound(table), best + 1e-9);
  }
}

TEST(Sequences, KeepRelationsBetweenManyTasks) {
  auto problem = random_sequences(4, 4, 30, SequenceObjective::kLastEnd);
  for (std::size_t t = 0; t + 3 < 30; t += 3)
    problem.relations.push_back({Kind::kBefore, t, t + 3, 0});
  Effort effort;
  effort.iterations = 100'000;
  const auto answer = best_sequences(problem, effort);
  ASSERT_TRUE(answer.ok());
  EXPECT_TRUE(answer.value().feasible);
  for (const TaskRelation& r : problem.relations)
    EXPECT_GE(answer.value().begin[r.second],
              answer.value().begin[r.first] + problem.tasks[r.first].service - 1e-9);
  EXPECT_LE(answer.value().quality.bound, answer.value().quality.value);
  const auto again = best_sequences(problem, effort);
  EXPECT_EQ(again.value().routes, answer.value().routes);
}

// Relations that an answer keeps anyhow cost nothing: the search must find as good a one,
// though its first routes wait for each other without end.
TEST(Sequences, FindWithRelationsWhatTheyDoWithout) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SequenceProblem problem = random_sequences(seed, 4, 30, SequenceObjective::kLastEnd);
    const auto free = best_sequences(problem, {.iterations = 300'000});
    ASSERT_TRUE(free.ok());
    const auto& begin = free.value().begin;
    SearchRandom random(seed, 12);
    while (problem.relations.size() < 15) {
      const std::size_t s = random.below(30), t = random.below(30);
      if (begin[s] + problem.tasks[s].service <= begin[t])
        problem.relations.push_back({Kind::kBefore, s, t, 0});
    }
    const auto tied = best_sequences(problem, {.iterations = 300'000});
    ASSERT_TRUE(tied.ok());
    EXPECT_TRUE(tied.value().feasible) << seed;
    EXPECT_LT(tied.value().quality.value, 1.12 * free.value().quality.value) << seed;
  }
}

TEST(Sequences, EndWhenTimeIsUp) {
  const auto problem = random_sequences(5, 5, 60, SequenceObjective::kTotal);
  Effort effort;
  effort.used = [] { return 1.0; };
  const auto answer = best_sequences(problem, effort);
  ASSERT_TRUE(answer.ok());
  expect_whole(problem, answer.value());
}

TEST(Sequences, RefuseWhatMakesNoSense) {
  const auto good = random_sequences(1, 2, 4, SequenceObjective::kLastEnd);
  const auto refused = [&](auto change) {
    SequenceProblem problem = good;
    change(problem);
    return !best_sequences(problem, {}).ok();
  };
  EXPECT_TRUE(refused([](auto& p) { p.tasks[0].service = -1; }));
  EXPECT_TRUE(refused([](auto& p) { p.tasks[0].eligible = {false, false}; }));
  EXPECT_TRUE(refused([](auto& p) { p.tasks[0].closes = -1; }));
  EXPECT_TRUE(refused([](auto& p) { p.relations = {{Kind::kBefore, 0, 9, 0}}; }));
  EXPECT_TRUE(refused([](auto& p) {
    p.relations = {{Kind::kBefore, 0, 1, 0}, {Kind::kBefore, 1, 0, 0}};
  }));
  EXPECT_TRUE(refused([](auto& p) {
    p.relations = {{Kind::kTogether, 0, 1, 0}, {Kind::kBefore, 1, 0, 0}};
  }));
  EXPECT_TRUE(refused([](auto& p) {
    p.orders = {{TaskOrder::Kind::kTask, 0, {}}, {TaskOrder::Kind::kTask, 0, {}}};
  }));
  EXPECT_TRUE(refused([](auto& p) {
    p.from_start = [](std::size_t, std::size_t) { return std::nan(""); };
  }));
  EXPECT_TRUE(refused([](auto& p) { p.aircraft = 0; }));
}

}  // namespace
}  // namespace skein::solve::sequences_test
