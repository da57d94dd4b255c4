// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/coalitions.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"
#include "skein/solve/allocation/coalition_annealing.h"
#include "skein/solve/allocation/coalition_groups.h"
#include "skein/solve/allocation/coalition_proof.h"
#include "skein/solve/allocation/coalition_subsets.h"

namespace skein::solve {
namespace {

constexpr std::size_t kIdle = CoalitionAnswer::kIdle;
constexpr int kStarts = 5;
constexpr std::int64_t kMovesPerAircraft = 2'000;  // of one start
constexpr double kSearchShare = 0.7;               // of the time; the rest for the bound

void check_problem(const CoalitionProblem& problem) {
  const auto good = [](double x) { return std::isfinite(x); };
  for (const CoalitionTask& task : problem.tasks) {
    SKEIN_CHECK(task.brings.size() == problem.aircraft, task.brings.size());
    SKEIN_CHECK(task.cost.size() == problem.aircraft, task.cost.size());
    SKEIN_CHECK(std::all_of(task.brings.begin(), task.brings.end(),
                            [&](double x) { return good(x) && x >= 0; }),
                "what an aircraft brings");
    SKEIN_CHECK(std::all_of(task.cost.begin(), task.cost.end(), good), "cost");
  }
  SKEIN_CHECK(problem.idle_allowed || problem.aircraft == 0 || !problem.tasks.empty(),
              problem.aircraft);
}

// The best place for an aircraft that has none.
struct Place {
  double gain;
  std::size_t task;
};
Place best_place(const CoalitionProblem& problem, const CoalitionGroups& groups,
                 std::size_t i) {
  Place best{-1e300, kIdle};
  for (std::size_t k = 0; k < problem.tasks.size(); ++k) {
    const double gain = groups.change(k, kIdle, i);
    if (gain > best.gain) best = {gain, k};
  }
  return best;
}

CoalitionAnswer search(const CoalitionProblem& problem, const Effort& effort) {
  CoalitionAnswer answer;
  const std::vector<std::size_t> start = greedy_coalitions(problem);
  answer.task = start;
  polish_coalitions(problem, answer.task);
  answer.quality.value = utility_of(problem, answer.task);
  const std::int64_t all =
      effort.iterations > 0
          ? effort.iterations
          : kStarts * kMovesPerAircraft * static_cast<std::int64_t>(problem.aircraft);
  Effort part = effort;
  if (effort.used) part.used = [&effort] { return effort.used() / kSearchShare; };
  for (std::uint32_t k = 0; k < kStarts && !part.ended(); ++k) {
    std::vector<std::size_t> task = start;
    answer.quality.iterations += anneal_coalitions(problem, part, all / kStarts, k, task);
    const double utility = utility_of(problem, task);
    if (utility > answer.quality.value) {
      answer.quality.value = utility;
      answer.task = std::move(task);
    }
  }
  return answer;
}

}  // namespace

double satisfaction_of(const CoalitionTask& task,
                       const std::vector<std::size_t>& members) {
  double brought = 0;
  for (const std::size_t i : members)
    brought = task.form == Satisfaction::kBest ? std::max(brought, task.brings[i])
                                               : brought + task.brings[i];
  return satisfaction_of_sum(task.form, brought);
}

double utility_of(const CoalitionProblem& problem, const std::vector<std::size_t>& task) {
  std::vector<std::vector<std::size_t>> members(problem.tasks.size());
  for (std::size_t i = 0; i < task.size(); ++i)
    if (task[i] != kIdle) members[task[i]].push_back(i);
  double utility = 0;
  for (std::size_t k = 0; k < members.size(); ++k) {
    utility += satisfaction_of(problem.tasks[k], members[k]);
    for (const std::size_t i : members[k]) utility -= problem.tasks[k].cost[i];
  }
  return utility;
}

std::vector<std::size_t> greedy_coalitions(const CoalitionProblem& problem) {
  CoalitionGroups groups(problem, std::vector<std::size_t>(problem.aircraft, kIdle));
  for (;;) {
    Place best{0, kIdle};
    std::size_t who = 0;
    for (std::size_t i = 0; i < problem.aircraft; ++i) {
      if (groups.task_of(i) != kIdle) continue;
      const Place place = best_place(problem, groups, i);
      if (place.gain > best.gain) {
        best = place;
        who = i;
      }
    }
    if (best.task == kIdle) break;
    groups.move(who, best.task);
  }
  if (!problem.idle_allowed)
    for (std::size_t i = 0; i < problem.aircraft; ++i)
      if (groups.task_of(i) == kIdle) groups.move(i, best_place(problem, groups, i).task);
  return groups.task();
}

CoalitionAnswer best_coalitions(const CoalitionProblem& problem, const Effort& effort) {
  check_problem(problem);
  if (problem.aircraft <= kMaxSubsetAircraft) return best_coalitions_by_subsets(problem);
  CoalitionAnswer answer = search(problem, effort);
  bound_coalitions(problem, effort, answer);
  return answer;
}

}  // namespace skein::solve
