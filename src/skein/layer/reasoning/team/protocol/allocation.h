// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "skein/data/team/team_message.h"

namespace skein::reasoning {

/// A member that can be given tasks.
struct TeamWorker {
  EntityId id;
  TeamResources resources;
  std::vector<std::uint32_t> tasks;  ///< that it executes now
  std::vector<double> shares =
      {};  ///< of each that is done, from 0 to 1; none: not known
};

/// Whether a member has said that it cannot fly the task of a number.
bool refuses(const TeamResources& member, std::uint32_t task);

/// A member as it says of itself: with the tasks that it has not done yet.
TeamWorker worker_of(EntityId id, const TeamInform& inform);

/// For each worker the numbers of its tasks, in the order in which it flies them.
using TeamAllocation = std::map<EntityId, std::vector<std::uint32_t>>;

/// An allocation, and how good it is.
struct TeamAllocated {
  TeamAllocated() = default;
  TeamAllocated(TeamAllocation all) : given(std::move(all)) {}

  TeamAllocation given;
  std::optional<double> value = std::nullopt;  ///< utility; none: it is not measured
  std::optional<double> bound = std::nullopt;  ///< no allocation is better
};

/// Shares tasks among workers: every worker has an entry, no single task two workers.
/// Of TeamTask::after there is only what is not over. What waits may be given, but is not
/// ordered yet (orderable()).
using AllocateTasks =
    std::function<TeamAllocated(std::span<const TeamTask>, std::span<const TeamWorker>)>;

/// Divides tasks between two teams: the numbers of those that the first one gets.
using DivideTasks = std::function<std::set<std::uint32_t>(
    std::span<const TeamTask>, std::span<const TeamWorker> first,
    std::span<const TeamWorker> second)>;

/// Those that can be flown now.
std::vector<TeamTask> ready_of(std::span<const TeamTask> tasks);

/// What a worker is ordered of the tasks that it is given: the first kMaxOrdered that do
/// not wait for others' tasks; it flies those behind one that waits meanwhile.
inline constexpr std::size_t kMaxOrdered = 8;
std::vector<std::uint32_t> orderable(const std::vector<std::uint32_t>& given,
                                     std::span<const TeamTask> tasks);

/// One task a worker: each keeps the first of its own (of two with the same the lower
/// id), then the nearest pairs of a free worker and a task that nobody has; workers that
/// are left join the nearest group task.
TeamAllocation allocate_nearest(std::span<const TeamTask> all,
                                std::span<const TeamWorker> workers);

/// Tasks stay with the team that executes them (both: the first); the others are shared
/// so that numbers of tasks come near the numbers of workers, in the order of their
/// numbers.
std::set<std::uint32_t> divide_by_size(std::span<const TeamTask> tasks,
                                       std::span<const TeamWorker> first,
                                       std::span<const TeamWorker> second);

}  // namespace skein::reasoning
