// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "skein/solve/allocation/sequences.h"

namespace skein::solve {

/// A sequence problem of one selection of tasks, as numbers.
struct SequenceTable {
  struct Precedence {
    std::size_t before, after;
    double gap;  ///< between end and begin [s]
  };

  std::size_t aircraft = 0, tasks = 0;
  std::vector<std::size_t> name;  ///< of each task in the problem
  std::vector<double> start, between, home, service, opens, closes, value;
  std::vector<bool> eligible;
  std::vector<Precedence> precedences;
  std::vector<std::size_t> together;  ///< by task: the least that begins with it
  bool returns = false;
  SequenceObjective objective = SequenceObjective::kLastEnd;
  double discount = 0;

  double start_of(std::size_t a, std::size_t t) const { return start[a * tasks + t]; }
  double leg(std::size_t a, std::size_t from, std::size_t to) const {
    return between[(a * tasks + from) * tasks + to];
  }
  double home_of(std::size_t a, std::size_t t) const {
    return returns ? home[a * tasks + t] : 0;
  }
  bool may(std::size_t a, std::size_t t) const { return eligible[a * tasks + t]; }
  bool is_coupled() const {
    for (std::size_t t = 0; t < tasks; ++t)
      if (together[t] != t) return true;
    return !precedences.empty();
  }
  bool has_windows() const {
    for (std::size_t t = 0; t < tasks; ++t)
      if (opens[t] > 0 || std::isfinite(closes[t])) return true;
    return false;
  }
};

/// What is the same in all selections of a problem.
class SequenceSelections {
 public:
  /// Fails: as best_sequences().
  static Result<SequenceSelections> of(const SequenceProblem& problem);

  std::size_t count() const { return selections_.size(); }
  SequenceTable table(std::size_t selection) const;

  struct Selection {
    std::vector<bool> done;  // by task
    std::vector<SequenceTable::Precedence> precedences;
  };

 private:
  const SequenceProblem* problem_ = nullptr;
  std::vector<Selection> selections_;
  std::vector<double> start_, between_, home_;
};

}  // namespace skein::solve
