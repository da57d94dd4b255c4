// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/allocation.h"

#include <algorithm>

namespace skein::reasoning {
namespace {

double distance(const TeamTask& task, const TeamWorker& worker) {
  return (task.place - geo::horizontal(worker.resources.place)).norm();
}

// Who executes a task already keeps it.
void keep_tasks(std::span<const TeamTask> tasks, std::span<const TeamWorker> workers,
                TeamAllocation& given, std::set<std::uint32_t>& taken) {
  for (const TeamWorker& worker : workers)
    for (const std::uint32_t number : worker.tasks) {
      const auto task = std::ranges::find(tasks, number, &TeamTask::number);
      if (task == tasks.end() || refuses(worker.resources, number) ||
          (task->single && taken.contains(number)))
        continue;
      given[worker.id] = {number};
      taken.insert(number);
      break;
    }
}

// The nearest pair of a worker without a task and a task that `open` allows, given;
// false when there is none.
template <class Open>
bool give_nearest(std::span<const TeamTask> tasks, std::span<const TeamWorker> workers,
                  TeamAllocation& given, std::set<std::uint32_t>& taken, Open&& open) {
  const TeamTask* best_task = nullptr;
  const TeamWorker* best_worker = nullptr;
  for (const TeamTask& task : tasks) {
    if (!open(task)) continue;
    for (const TeamWorker& worker : workers) {
      if (!given[worker.id].empty() || refuses(worker.resources, task.number)) continue;
      if (best_task && distance(task, worker) >= distance(*best_task, *best_worker))
        continue;
      best_task = &task;
      best_worker = &worker;
    }
  }
  if (!best_task) return false;
  given[best_worker->id] = {best_task->number};
  taken.insert(best_task->number);
  return true;
}

std::set<std::uint32_t> executed(std::span<const TeamWorker> workers) {
  std::set<std::uint32_t> all;
  for (const TeamWorker& worker : workers)
    all.insert(worker.tasks.begin(), worker.tasks.end());
  return all;
}

}  // namespace

TeamWorker worker_of(EntityId id, const TeamInform& inform) {
  TeamWorker worker{id, inform.resources, {}};
  for (const TeamProgress& task : inform.tasks)
    if (task.share < 1) {
      worker.tasks.push_back(task.task);
      worker.shares.push_back(task.share);
    }
  return worker;
}

bool refuses(const TeamResources& member, std::uint32_t task) {
  return std::ranges::find(member.refused, task) != member.refused.end();
}

std::vector<TeamTask> ready_of(std::span<const TeamTask> tasks) {
  std::vector<TeamTask> ready;
  for (const TeamTask& task : tasks)
    if (task.after.empty()) ready.push_back(task);
  return ready;
}

std::vector<std::uint32_t> orderable(const std::vector<std::uint32_t>& given,
                                     std::span<const TeamTask> tasks) {
  std::vector<std::uint32_t> ordered;
  for (const std::uint32_t number : given) {
    const auto task = std::ranges::find(tasks, number, &TeamTask::number);
    if (task == tasks.end()) continue;
    const bool waits = std::ranges::any_of(task->after, [&](std::uint32_t before) {
      return std::ranges::find(ordered, before) == ordered.end();
    });
    if (!waits && ordered.size() < kMaxOrdered) ordered.push_back(number);
  }
  return ordered;
}

TeamAllocation allocate_nearest(std::span<const TeamTask> all,
                                std::span<const TeamWorker> workers) {
  const std::vector<TeamTask> tasks = ready_of(all);
  TeamAllocation given;
  for (const TeamWorker& worker : workers) given[worker.id] = {};
  std::set<std::uint32_t> taken;
  keep_tasks(tasks, workers, given, taken);
  const auto untaken = [&](const TeamTask& t) { return !taken.contains(t.number); };
  while (give_nearest(tasks, workers, given, taken, untaken)) {
  }
  const auto of_groups = [](const TeamTask& t) { return !t.single; };
  while (give_nearest(tasks, workers, given, taken, of_groups)) {
  }
  return given;
}

std::set<std::uint32_t> divide_by_size(std::span<const TeamTask> tasks,
                                       std::span<const TeamWorker> first,
                                       std::span<const TeamWorker> second) {
  const auto by_first = executed(first), by_second = executed(second);
  std::set<std::uint32_t> given;
  std::size_t of_first = 0, of_second = 0;
  std::vector<std::uint32_t> open;
  for (const TeamTask& task : tasks) {
    if (by_first.contains(task.number)) {
      given.insert(task.number);
      ++of_first;
    } else if (by_second.contains(task.number)) {
      ++of_second;
    } else {
      open.push_back(task.number);
    }
  }
  for (const std::uint32_t number : open) {
    // To whom has fewer for each worker; of equal ones to the first.
    const bool to_first = of_first * std::max<std::size_t>(1, second.size()) <=
                          of_second * std::max<std::size_t>(1, first.size());
    ++(to_first ? of_first : of_second);
    if (to_first) given.insert(number);
  }
  return given;
}

}  // namespace skein::reasoning
