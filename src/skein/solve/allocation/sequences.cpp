// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/sequences.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/solve/allocation/sequence_annealing.h"
#include "skein/solve/allocation/sequence_orders.h"
#include "skein/solve/allocation/sequence_subsets.h"

namespace skein::solve {
namespace {

constexpr std::int64_t kSequenceMoves = 3'000'000;
constexpr std::int64_t kMovesBeforeOrders = 20'000;
constexpr double kSameCost = 1e-9;  // relative

// The answer for one selection of tasks, costs to be minimised.
struct SelectionAnswer {
  SequenceRoutes routes;
  SequenceSchedule schedule;
  double cost = 0, bound = 0;
  bool feasible = false, proven = false;
};

SelectionAnswer rated(const SequenceTable& table, SequenceRoutes routes) {
  SelectionAnswer answer;
  answer.schedule = schedule_of(table, routes);
  answer.cost = cost_of(table, answer.schedule);
  answer.feasible = answer.schedule.late == 0;
  answer.routes = std::move(routes);
  return answer;
}

SelectionAnswer solve(const SequenceTable& table, const Effort& effort,
                      std::int64_t moves, std::int64_t& iterations) {
  if (can_be_done_by_subsets(table)) {
    if (auto routes = best_by_subsets(table, iterations)) {
      SelectionAnswer answer = rated(table, std::move(*routes));
      answer.bound = answer.cost;
      answer.proven = true;
      return answer;
    }
    moves = std::min(moves, kMovesBeforeOrders);  // no answer keeps all windows
  }
  const bool few = table.tasks <= kMaxOrderedTasks;
  SelectionAnswer answer =
      rated(table, anneal_sequences(table, effort,
                                    few ? std::min(moves, kMovesBeforeOrders) : moves,
                                    iterations));
  answer.bound = std::min(cost_bound(table), answer.cost);
  if (few) {
    // What costs as much as the answer is no news, unless the answer is not feasible.
    const double limit = answer.feasible ? answer.cost : math::kInfinity;
    OrderedRoutes ordered = best_by_orders(table, limit, effort, iterations);
    if (ordered.found) answer = rated(table, std::move(ordered.routes));
    answer.bound = ordered.complete && answer.feasible
                       ? answer.cost
                       : std::min(cost_bound(table), answer.cost);
    answer.proven = ordered.complete && answer.feasible;
  } else if (answer.feasible &&
             answer.cost <= answer.bound + kSameCost * std::abs(answer.cost)) {
    answer.proven = true;
  }
  return answer;
}

bool is_better(const SelectionAnswer& a, const SelectionAnswer& b) {
  if (a.feasible != b.feasible) return a.feasible;
  if (!a.feasible && a.schedule.late != b.schedule.late)
    return a.schedule.late < b.schedule.late;
  return a.cost < b.cost;
}

}  // namespace

Result<SequenceAnswer> best_sequences(const SequenceProblem& problem,
                                      const Effort& effort) {
  const auto selections = SequenceSelections::of(problem);
  if (!selections) return selections.error();
  const std::size_t count = selections.value().count();
  const std::int64_t moves =
      effort.moves(kSequenceMoves) / static_cast<std::int64_t>(count);
  SequenceAnswer answer;
  SelectionAnswer best;
  SequenceTable best_table;
  double bound = math::kInfinity;
  bool all_proven = true;
  for (std::size_t k = 0; k < count; ++k) {
    const SequenceTable table = selections.value().table(k);
    Effort part = effort;
    if (effort.used && count > 1)
      part.used = [&effort, k, count] {  // its share of the time, and what was left over
        const double share = static_cast<double>(k + 1) / static_cast<double>(count);
        return effort.used() / share;
      };
    const SelectionAnswer found =
        solve(table, part, std::max<std::int64_t>(moves, 1), answer.quality.iterations);
    bound = std::min(bound, found.bound);
    all_proven = all_proven && found.proven;
    if (k > 0 && !is_better(found, best)) continue;
    best = found;
    best_table = table;
  }
  const double sign = problem.objective == SequenceObjective::kDiscounted ? -1 : 1;
  answer.feasible = best.feasible;
  answer.quality.value = sign * best.cost;
  answer.quality.bound = sign * std::min(bound, best.cost);
  answer.quality.proven =
      best.feasible &&
      (all_proven || best.cost <= bound + kSameCost * std::abs(best.cost));
  answer.routes.resize(problem.aircraft);
  answer.begin.assign(problem.tasks.size(), std::nan(""));
  for (std::size_t a = 0; a < best.routes.size(); ++a)
    for (const std::size_t t : best.routes[a])
      answer.routes[a].push_back(best_table.name[t]);
  for (std::size_t t = 0; t < best_table.tasks; ++t)
    answer.begin[best_table.name[t]] = best.schedule.begin[t];
  return answer;
}

}  // namespace skein::solve
