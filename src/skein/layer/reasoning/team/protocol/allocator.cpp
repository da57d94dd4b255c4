// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/allocator.h"

#include <algorithm>
#include <cstddef>
#include <set>

namespace skein::reasoning {
namespace {

// A worker that executes these, with what it has done of them.
void give(TeamWorker& worker, const std::vector<std::uint32_t>& tasks) {
  std::vector<double> shares;
  for (const std::uint32_t task : tasks) {
    const auto at = std::ranges::find(worker.tasks, task) - worker.tasks.begin();
    const auto place = static_cast<std::size_t>(at);
    shares.push_back(place < worker.shares.size() ? worker.shares[place] : 0);
  }
  worker.tasks = tasks;
  worker.shares = std::move(shares);
}

}  // namespace

void TeamAllocator::begin() {
  in_force_.clear();
  approval_.clear();
}

void TeamAllocator::look(MemberState& member) {
  const double period = member.config.allocation_period;
  const TeamResources& own = member.own.resources();
  if ((period > 0 && member.now - allocated_ >= period) || able_ != own.able ||
      refused_ != own.refused)
    member.allocation_due = true;
  able_ = own.able;
  refused_ = own.refused;
}

void TeamAllocator::allocate(MemberState& member, ProposalDisplay& display,
                             std::span<const TeamTask> tasks,
                             std::vector<TeamWorker> workers) {
  member.allocation_due = false;
  allocated_ = member.now;
  if (!member.config.approval) {
    const TeamAllocated found = member.config.allocate(tasks, workers);
    const bool is_new = found.given != in_force_;
    in_force_ = found.given;
    if (is_new) record_allocation(member, AllocationState::kUnasked, 0, found);
    return;
  }
  keep_in_force(tasks, workers);
  take_over(member, tasks, workers);
  TeamAllocated found = member.config.allocate(tasks, workers);
  found.given = without_idle(std::move(found.given));
  approval_.propose(member, display, tasks, workers, std::move(found),
                    without_idle(in_force_));
}

// What is in force stays so as long as its tasks and members are there; of members that
// another one led before it is what they execute.
void TeamAllocator::keep_in_force(std::span<const TeamTask> tasks,
                                  std::vector<TeamWorker>& workers) {
  TeamAllocation kept;
  std::set<std::uint32_t> taken;
  for (TeamWorker& worker : workers) {
    const auto known = in_force_.find(worker.id);
    const auto had = known != in_force_.end() ? known->second : worker.tasks;
    std::vector<std::uint32_t>& keeps = kept[worker.id];
    for (const std::uint32_t number : had) {
      const auto task = std::ranges::find(tasks, number, &TeamTask::number);
      if (task == tasks.end() || !task->released || refuses(worker.resources, number))
        continue;
      if (taken.insert(number).second || !task->single) keeps.push_back(number);
    }
    give(worker, keeps);
  }
  in_force_ = std::move(kept);
}

// Approved tasks that nobody flies any more go to who is idle.
void TeamAllocator::take_over(MemberState& member, std::span<const TeamTask> tasks,
                              std::vector<TeamWorker>& workers) {
  std::set<std::uint32_t> flown;
  std::vector<TeamWorker> idle;
  for (const TeamWorker& worker : workers) {
    flown.insert(worker.tasks.begin(), worker.tasks.end());
    if (worker.tasks.empty()) idle.push_back(worker);
  }
  std::vector<TeamTask> left;
  for (const TeamTask& task : tasks)
    if (task.released && !flown.contains(task.number)) left.push_back(task);
  if (left.empty() || idle.empty()) return;
  // A copy: what it remembers is of whole allocations.
  const AllocateTasks once = member.config.allocate;
  const TeamAllocation found = without_idle(once(left, idle).given);
  if (found.empty()) return;
  for (const auto& [id, given] : found) {
    in_force_[id] = given;
    give(*std::ranges::find(workers, id, &TeamWorker::id), given);
  }
  record_allocation(member, AllocationState::kTakenOver, 0, in_force_);
}

bool TeamAllocator::settle(MemberState& member, ProposalDisplay& display, EntityId from,
                           const TeamDecision& decision, std::span<const TeamTask> tasks,
                           std::span<const TeamWorker> workers) {
  const auto approved = approval_.settle(member, display, from, decision, tasks, workers);
  if (!approved) return false;
  for (const TeamWorker& worker : workers) in_force_[worker.id].clear();
  for (const auto& [id, given] : *approved) {
    in_force_[id] = given;
    for (const std::uint32_t task : given)
      member.knowledge.tasks.at(task).released = true;
  }
  return true;
}

}  // namespace skein::reasoning
