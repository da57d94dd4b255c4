// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/onboard/coalition_allocation.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "skein/layer/reasoning/team/onboard/task_needs.h"

namespace skein::reasoning {
namespace {

using solve::CoalitionAnswer;
using solve::CoalitionProblem;
using solve::CoalitionTask;
using solve::Satisfaction;

constexpr double kMaxMargin = 1.5;  // more endurance is of no more use
constexpr double kKeep = 0.05;      // of a task, for who executes it
constexpr double kHovering = 1.1;   // of a task that is about one place
constexpr double kLongest = 1.01;   // costs stay below 1
constexpr double kJoining = 1e-3;   // of a place that it is at already
constexpr double kOutOfReach = 2;   // cost of what cannot be reached
constexpr double kHour = 3600;      // [s]

// By how much one aircraft satisfies a task.
double satisfaction_of_one(const TeamTask& task, const TaskNeeds& needs,
                           const TeamResources& resources,
                           const FlightConditions& conditions) {
  if (!may_be_given(task, resources)) return 0;
  const auto approach = time_to_begin(needs, resources, conditions);
  const auto within = time_within(needs, resources, conditions);
  const auto home = time_home(needs, resources, conditions);
  if (!approach || !within || !home) return 0;
  const double needed = std::max(1.0, kEnduranceReserve * (*approach + *within + *home));
  // What has no end is flown as long as there is endurance.
  const double margin =
      needs.endless ? 1.0 : std::min(kMaxMargin, resources.endurance / needed);
  if (margin < 1) return 0;
  const bool hovers = (resources.sensors & kHovers) != 0;
  return needs.better_hovering && hovers ? margin * kHovering : margin;
}

// The share of a task that is done by who executes it; none: it does not.
std::optional<double> share_of(const TeamWorker& worker, std::uint32_t task) {
  const auto found = std::ranges::find(worker.tasks, task);
  if (found == worker.tasks.end()) return std::nullopt;
  const auto place = static_cast<std::size_t>(found - worker.tasks.begin());
  return place < worker.shares.size() ? worker.shares[place] : 0;
}

std::vector<std::size_t> present(std::span<const TeamTask> tasks,
                                 std::span<const TeamWorker> workers) {
  std::vector<std::size_t> all;
  std::set<std::uint32_t> taken;
  for (const TeamWorker& worker : workers) {
    std::size_t own = CoalitionAnswer::kIdle;
    for (std::size_t k = 0; k < tasks.size() && own == CoalitionAnswer::kIdle; ++k)
      if (share_of(worker, tasks[k].number) &&
          (!tasks[k].single || taken.insert(tasks[k].number).second))
        own = k;
    all.push_back(own);
  }
  return all;
}

auto idle_of(const std::vector<std::size_t>& tasks) {
  return std::ranges::count(tasks, CoalitionAnswer::kIdle);
}

}  // namespace

CoalitionProblem CoalitionAllocation::problem_of(std::span<const TeamTask> tasks,
                                                 std::span<const TeamWorker> workers) {
  std::map<Executed, double> nearest;
  CoalitionProblem problem;
  problem.aircraft = workers.size();
  double longest = 1;
  std::vector<std::vector<std::optional<double>>> times;
  for (const TeamTask& task : tasks) {
    const TaskNeeds needs = needs_of(task);
    CoalitionTask row;
    row.form = task.single ? Satisfaction::kBest : Satisfaction::kRoot;
    std::vector<std::optional<double>> to_begin;
    for (const TeamWorker& worker : workers) {
      // Who has begun with it is there; what is done would have to be done again.
      const auto share = share_of(worker, task.number);
      TaskNeeds left = needs;
      if (share && *share > 0) {
        left.begin.reset();
        left.length *= 1 - *share;
        left.stay *= 1 - *share;
      }
      double brings = satisfaction_of_one(task, left, worker.resources, *conditions_);
      if (!task.single && brings > 0) brings = 1;
      if (share) brings *= 1 + kKeep + *share;
      row.brings.push_back(brings);
      auto time = time_to_begin(left, worker.resources, *conditions_);
      if (share && time) {
        const Executed executed{worker.id, task.number};
        const auto before = nearest_.find(executed);
        if (before != nearest_.end()) time = std::min(*time, before->second);
        nearest[executed] = *time;
      }
      to_begin.push_back(time);
      longest = std::max(longest, to_begin.back().value_or(0));
    }
    times.push_back(std::move(to_begin));
    problem.tasks.push_back(std::move(row));
  }
  nearest_ = std::move(nearest);
  for (std::size_t k = 0; k < times.size(); ++k)
    for (const auto& time : times[k])
      problem.tasks[k].cost.push_back(time ? kJoining + *time / (kLongest * longest)
                                           : kOutOfReach);
  return problem;
}

TeamAllocated CoalitionAllocation::operator()(std::span<const TeamTask> open,
                                              std::span<const TeamWorker> workers) {
  const std::vector<TeamTask> tasks = ready_of(open);
  std::set<std::uint32_t> numbers;
  std::set<EntityId> ids;
  for (const TeamTask& task : tasks) numbers.insert(task.number);
  for (const TeamWorker& worker : workers) ids.insert(worker.id);
  const bool changed = numbers != tasks_ || ids != workers_;
  tasks_ = std::move(numbers);
  workers_ = std::move(ids);

  const CoalitionProblem problem = problem_of(tasks, workers);
  std::vector<std::size_t> kept = present(tasks, workers);
  const CoalitionAnswer found = solve::best_coalitions(problem, {});
  const double present_value = solve::utility_of(problem, kept);
  // Who waits for an order counts as idle still: it is not to lose what it was given.
  const bool busier = idle_of(found.task) < idle_of(kept);
  const bool better =
      solve::is_worth_changing(present_value, found.quality.value, changed || busier);
  const std::vector<std::size_t>& chosen = better ? found.task : kept;
  TeamAllocated all;
  all.value = better ? found.quality.value : present_value;
  all.bound = found.quality.bound;
  for (std::size_t i = 0; i < workers.size(); ++i) {
    std::vector<std::uint32_t>& own = all.given[workers[i].id];
    if (chosen[i] != CoalitionAnswer::kIdle) own.push_back(tasks[chosen[i]].number);
  }
  return all;
}

double worth_of(const TeamTask& task, const TeamResources& self,
                std::span<const TeamTask> bundle, const FlightConditions& conditions) {
  TeamResources from = self;
  if (!bundle.empty()) from.place.head<2>() = bundle.back().place;
  const TaskNeeds needs = needs_of(task);
  const double satisfied = satisfaction_of_one(task, needs, from, conditions);
  if (satisfied <= 0) return 0;
  const double hours = time_to_begin(needs, from, conditions).value_or(0) / kHour;
  return satisfied / (1 + hours);
}

}  // namespace skein::reasoning
