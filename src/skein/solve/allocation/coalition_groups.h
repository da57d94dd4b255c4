// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "skein/solve/allocation/satisfaction_form.h"

namespace skein::solve {

/// An allocation while it changes: what each group brings is kept, so that the worth of a
/// move is known at once.
class CoalitionGroups {
 public:
  CoalitionGroups(const CoalitionProblem& problem, const std::vector<std::size_t>& task)
      : problem_(&problem), task_(task), members_(problem.tasks.size()) {
    for (std::size_t i = 0; i < task_.size(); ++i)
      if (task_[i] != CoalitionAnswer::kIdle) members_[task_[i]].push_back(i);
    brought_.resize(members_.size());
    satisfied_.resize(members_.size());
    for (std::size_t k = 0; k < members_.size(); ++k) measure(k);
  }

  const std::vector<std::size_t>& task() const { return task_; }
  std::size_t task_of(std::size_t i) const { return task_[i]; }
  const std::vector<std::size_t>& members(std::size_t k) const { return members_[k]; }

  /// What changes when `leaves` leaves task k (kIdle: nobody) and `joins` joins it.
  double change(std::size_t k, std::size_t leaves, std::size_t joins) const {
    if (k == CoalitionAnswer::kIdle) return 0;
    const CoalitionTask& task = problem_->tasks[k];
    double brought = brought_[k], cost = 0;
    if (leaves != CoalitionAnswer::kIdle) {
      brought = without(k, leaves);
      cost -= task.cost[leaves];
    }
    if (joins != CoalitionAnswer::kIdle) {
      brought = task.form == Satisfaction::kBest ? std::max(brought, task.brings[joins])
                                                 : brought + task.brings[joins];
      cost += task.cost[joins];
    }
    return satisfaction_of_sum(task.form, brought) - satisfied_[k] - cost;
  }

  void move(std::size_t i, std::size_t to) {
    const std::size_t from = task_[i];
    if (from != CoalitionAnswer::kIdle) {
      auto& group = members_[from];
      group.erase(std::find(group.begin(), group.end(), i));
      measure(from);
    }
    task_[i] = to;
    if (to == CoalitionAnswer::kIdle) return;
    members_[to].push_back(i);
    measure(to);
  }

 private:
  double without(std::size_t k, std::size_t leaves) const {
    const CoalitionTask& task = problem_->tasks[k];
    if (task.form != Satisfaction::kBest)
      return members_[k].size() == 1 ? 0 : brought_[k] - task.brings[leaves];
    if (task.brings[leaves] < brought_[k]) return brought_[k];
    double most = 0;
    for (const std::size_t i : members_[k])
      if (i != leaves) most = std::max(most, task.brings[i]);
    return most;
  }
  // From the members, so that no rounding adds up.
  void measure(std::size_t k) {
    const CoalitionTask& task = problem_->tasks[k];
    double brought = 0;
    for (const std::size_t i : members_[k])
      brought = task.form == Satisfaction::kBest ? std::max(brought, task.brings[i])
                                                 : brought + task.brings[i];
    brought_[k] = brought;
    satisfied_[k] = satisfaction_of_sum(task.form, brought);
  }

  const CoalitionProblem* problem_;
  std::vector<std::size_t> task_;
  std::vector<std::vector<std::size_t>> members_;
  std::vector<double> brought_, satisfied_;
};

}  // namespace skein::solve
