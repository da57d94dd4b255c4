// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/solve/allocation/answer.h"

namespace skein::solve {

/// What a sequence of tasks is judged by.
enum class SequenceObjective {
  kLastEnd,     ///< minimise when the last work ends, or the last aircraft is home
  kTotal,       ///< minimise the sum over aircraft of when each ends
  kDiscounted,  ///< maximise sum of value x exp(-discount x when work on it begins)
};

/// A task that one aircraft does.
struct SequenceTask {
  double service = 0;  ///< time that it takes [s]
  double opens = 0;    ///< it begins no earlier; who comes earlier waits [s]
  double closes = std::numeric_limits<double>::infinity();  ///< it begins no later [s]
  double value = 0;            ///< kDiscounted only, not negative
  std::vector<bool> eligible;  ///< by aircraft; empty: all
};

/// How two tasks, or one and the clock, are tied.
struct TaskRelation {
  enum class Kind {
    kBefore,    ///< `first` ends at least `time` before `second` begins
    kAfter,     ///< `first` begins at least `time` after `second` ends
    kAt,        ///< `first` begins at `time`
    kTogether,  ///< both begin at the same time, by different aircraft
  };
  Kind kind = Kind::kBefore;
  std::size_t first = 0, second = 0;
  double time = 0;  ///< [s]
};

/// An order of tasks: one task, or parts that are done one after the other, of which one
/// is done, or that are done in any order. Tasks that no order names are done in any
/// case.
struct TaskOrder {
  enum class Kind { kTask, kSequence, kAlternative, kParallel };
  Kind kind = Kind::kTask;
  std::size_t task = 0;          ///< of kTask
  std::vector<TaskOrder> parts;  ///< of the others
};

/// Which aircraft does which tasks, in which order. Times count from now.
struct SequenceProblem {
  std::size_t aircraft = 0;
  std::vector<SequenceTask> tasks;
  /// Flight times [s], not negative, as the planner has them in this wind; each pair is
  /// asked once. `from_start` may have the aircraft's delay until it is free in it.
  std::function<double(std::size_t aircraft, std::size_t task)> from_start;
  std::function<double(std::size_t aircraft, std::size_t from, std::size_t to)> between;
  std::function<double(std::size_t aircraft, std::size_t task)> home;  ///< if they return
  bool returns = false;  ///< aircraft that did something fly home at last
  std::vector<TaskRelation> relations;
  std::vector<TaskOrder> orders;
  SequenceObjective objective = SequenceObjective::kLastEnd;
  double discount = 0;  ///< [1/s]
};

struct SequenceAnswer {
  /// `value` and `bound` [s], of kDiscounted in units of value. Of an answer that is not
  /// feasible, `value` leaves out how late it is.
  Quality quality;
  bool feasible = false;                         ///< all windows and relations are kept
  std::vector<std::vector<std::size_t>> routes;  ///< by aircraft
  std::vector<double> begin;  ///< by task, of its work [s]; not a number: not done
};

/// Shares tasks among aircraft, and orders them.
///
/// - Up to 14 tasks without relations between them: dynamic programming over subsets for
///   each aircraft, then over aircraft; proven. (Discounted values with windows: as
///   below.)
/// - Up to 8 tasks with relations: all orders of beginning, with a bound; proven unless
///   they are too many.
/// - Else annealing over routes, and a bound of relaxations.
/// - Alternatives: each selection of tasks on its own.
///
/// @param effort  iterations: moves of annealing; 0: 3 million.
/// Fails:     kBadInput for numbers that make no sense, tasks that nobody may do,
///            relations and orders of tasks that do not exist or follow themselves, or
///            more than 256 selections.
/// Cost:      14 tasks and 5 aircraft some 40 ms.
/// Reference: spec of the team, section 11; [Held62] for the dynamic program.
Result<SequenceAnswer> best_sequences(const SequenceProblem& problem,
                                      const Effort& effort);

}  // namespace skein::solve
