// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "skein/solve/allocation/answer.h"

namespace skein::solve {

/// How what the members of a group bring makes up how well their task is satisfied.
enum class Satisfaction {
  kRoot,   ///< x = sqrt(sum of what they bring): x from 1 on, else 0
  kBest,   ///< the most that one of them brings
  kShare,  ///< the sum of what they bring, at most 1
};

/// A task that takes a group of aircraft.
struct CoalitionTask {
  Satisfaction form = Satisfaction::kRoot;
  std::vector<double> brings;  ///< by aircraft, not negative
  std::vector<double> cost;    ///< by aircraft: what joining costs
};

/// Which aircraft does which task: each one at most.
///
///   u = sum over tasks of ( satisfaction(group) - sum of its members' costs )
struct CoalitionProblem {
  std::size_t aircraft = 0;
  std::vector<CoalitionTask> tasks;
  bool idle_allowed = true;  ///< an aircraft may stay without a task, which counts 0
};

struct CoalitionAnswer {
  static constexpr std::size_t kIdle = static_cast<std::size_t>(-1);
  Quality quality;                ///< `bound` is an upper bound
  std::vector<std::size_t> task;  ///< by aircraft; kIdle: none
};

/// How well a group satisfies a task, without costs.
double satisfaction_of(const CoalitionTask& task,
                       const std::vector<std::size_t>& members);

/// The utility of an allocation, as the problem defines it.
double utility_of(const CoalitionProblem& problem, const std::vector<std::size_t>& task);

/// Forms groups of the highest utility.
///
/// Up to 12 aircraft all subsets are looked at, and the answer is proven. Beyond,
/// annealing from a greedy start, several times over, each polished; then column
/// generation and branch and price bound it, and better it, up to a proof where that is
/// soon or `effort.prove` asks for it (coalition_proof.h).
///
/// @param effort  iterations: moves of annealing in all; 0: 5 starts of 2,000 moves for
///                each aircraft.
/// Fails:     Bug when a list is not as long as there are aircraft, a number is not
///            finite, or there are aircraft that may not be idle and no task.
/// Reference: spec of the team, section 11; [Barnhart98] for branch and price.
CoalitionAnswer best_coalitions(const CoalitionProblem& problem, const Effort& effort);

/// Each aircraft in turn where it raises the utility most, until none does; those that
/// may not be idle then go where they harm least. What annealing starts from.
std::vector<std::size_t> greedy_coalitions(const CoalitionProblem& problem);

}  // namespace skein::solve
