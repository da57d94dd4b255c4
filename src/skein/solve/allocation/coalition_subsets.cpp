// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/coalition_subsets.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "skein/base/check.h"
#include "skein/solve/allocation/satisfaction_form.h"

namespace skein::solve {
namespace {

using Mask = std::uint32_t;
constexpr double kImpossible = -std::numeric_limits<double>::infinity();

// Utility of each group for one task.
std::vector<double> group_utilities(const CoalitionTask& task, std::size_t aircraft) {
  const std::size_t groups = std::size_t{1} << aircraft;
  std::vector<double> brought(groups, 0), cost(groups, 0), utility(groups, 0);
  for (Mask g = 1; g < groups; ++g) {
    const auto i = static_cast<std::size_t>(std::countr_zero(g));
    const Mask rest = g & (g - 1);
    brought[g] = task.form == Satisfaction::kBest
                     ? std::max(brought[rest], task.brings[i])
                     : brought[rest] + task.brings[i];
    cost[g] = cost[rest] + task.cost[i];
    utility[g] = satisfaction_of_sum(task.form, brought[g]) - cost[g];
  }
  return utility;
}

// The best of all groups within `of` for the last task that was added, with what the
// earlier tasks make of the others.
struct Choice {
  double utility = kImpossible;
  Mask group = 0;
};
Choice best_within(Mask of, const std::vector<double>& utility,
                   const std::vector<double>& earlier) {
  Choice best{utility[0] + earlier[of], 0};
  for (Mask g = of; g != 0; g = (g - 1) & of) {
    const double u = utility[g] + earlier[of ^ g];
    if (u > best.utility) best = {u, g};
  }
  return best;
}

}  // namespace

CoalitionAnswer best_coalitions_by_subsets(const CoalitionProblem& problem) {
  SKEIN_CHECK(problem.aircraft <= 20, problem.aircraft);
  const std::size_t count = problem.tasks.size();
  const Mask all = (Mask{1} << problem.aircraft) - 1;
  // With no task yet: all idle, or impossible unless there is nobody.
  std::vector<double> best(all + std::size_t{1}, problem.idle_allowed ? 0 : kImpossible);
  best[0] = 0;
  std::vector<std::vector<Mask>> chosen(count);
  CoalitionAnswer answer;
  answer.task.assign(problem.aircraft, CoalitionAnswer::kIdle);
  for (std::size_t k = 0; k < count; ++k) {
    const std::vector<double> utility =
        group_utilities(problem.tasks[k], problem.aircraft);
    chosen[k].assign(all + std::size_t{1}, 0);
    std::vector<double> next(best.size(), kImpossible);
    for (Mask of = k + 1 == count ? all : 0; of <= all; ++of) {
      const bool alone = k == 0 && !problem.idle_allowed;  // takes whoever there is
      const Choice choice =
          alone ? Choice{utility[of], of} : best_within(of, utility, best);
      next[of] = choice.utility;
      chosen[k][of] = choice.group;
      answer.quality.iterations += std::int64_t{1} << std::popcount(of);
    }
    best = std::move(next);
  }
  Mask left = all;
  for (std::size_t k = count; k-- > 0; left ^= chosen[k][left])
    for (std::size_t i = 0; i < problem.aircraft; ++i)
      if (chosen[k][left] >> i & 1) answer.task[i] = k;
  answer.quality.value = utility_of(problem, answer.task);
  answer.quality.bound = answer.quality.value;
  answer.quality.proven = true;
  return answer;
}

}  // namespace skein::solve
