// SPDX-License-Identifier: Apache-2.0
// How a master has its allocations approved.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "skein/layer/reasoning/team/protocol/team_member.h"

namespace skein::reasoning {
namespace {

constexpr int kQuickProposals = 3;  // before they come with queries
constexpr double kRemind = 10;      // query periods, of what the operator is shown
constexpr int kWithdrawRepeats = 2;

TeamAllocation without_idle(TeamAllocation all) {
  std::erase_if(all, [](const auto& given) { return given.second.empty(); });
  return all;
}

// What can still be flown of an allocation.
TeamAllocation left_of(const TeamAllocation& all, const std::set<std::uint32_t>& tasks,
                       const std::set<EntityId>& members) {
  TeamAllocation left;
  for (const auto& [id, given] : all) {
    if (!members.contains(id)) continue;
    for (const std::uint32_t task : given)
      if (tasks.contains(task)) left[id].push_back(task);
  }
  return left;
}

std::set<std::uint32_t> numbers_in(std::span<const TeamTask> tasks) {
  std::set<std::uint32_t> all;
  for (const TeamTask& task : tasks) all.insert(task.number);
  return all;
}

std::set<EntityId> ids_in(std::span<const TeamWorker> workers) {
  std::set<EntityId> all;
  for (const TeamWorker& worker : workers) all.insert(worker.id);
  return all;
}

std::vector<TeamShare> shares_of(const TeamAllocation& all) {
  std::vector<TeamShare> shares;
  for (const auto& [id, tasks] : all)
    for (const std::uint32_t task : tasks) shares.push_back({id, task});
  return shares;
}

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

// What is in force stays so as long as its tasks and members are there; of members that
// another one led before it is what they execute.
void TeamMember::keep_in_force(std::span<const TeamTask> tasks,
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
void TeamMember::take_over(std::span<const TeamTask> tasks,
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
  AllocateTasks once = config_.allocate;
  const TeamAllocation found = without_idle(once(left, idle).given);
  if (found.empty()) return;
  for (const auto& [id, given] : found) {
    in_force_[id] = given;
    give(*std::ranges::find(workers, id, &TeamWorker::id), given);
  }
  note_allocation(AllocationState::kTakenOver, 0, in_force_);
}

// Who is about to hand over leaves that to its successor.
void TeamMember::propose(std::span<const TeamTask> tasks,
                         std::span<const TeamWorker> workers) {
  auto numbers = numbers_in(tasks);
  auto ids = ids_in(workers);
  TeamAllocated found = config_.allocate(tasks, workers);
  found.given = without_idle(std::move(found.given));
  TeamAllocation present = without_idle(in_force_);
  if (proposal_) {
    Proposal& old = *proposal_;
    if (old.tasks == numbers && old.members == ids && old.present == present) return;
    if (!old.rejected && found.given == left_of(old.allocated.given, numbers, ids) &&
        found.given != present) {
      old.tasks = std::move(numbers);
      old.members = std::move(ids);
      old.present = std::move(present);
      return;
    }
    withdraw();
  }
  if (found.given == present || leaves() || proposals_ >= kMaxProposalNumber) return;
  proposal_ = Proposal{++proposals_, std::move(found), std::move(present),
                       std::move(numbers), std::move(ids)};
  proposal_->quick = kQuickProposals;
  note_allocation(AllocationState::kWaits, proposals_, proposal_->allocated);
  const TeamProposal what = said(*proposal_, AllocationState::kWaits);
  report(EventKind::kTeamProposed, text_of(self_, what));
  if (is_desk(self_)) show(self_, what);
}

TeamProposal TeamMember::said(const Proposal& proposal, AllocationState state) const {
  TeamProposal what{*mission_, proposal.number, state};
  if (state != AllocationState::kWaits) return what;
  const TeamAllocated& all = proposal.allocated;
  if (all.value) what.value = static_cast<float>(*all.value);
  if (all.bound) what.bound = static_cast<float>(*all.bound);
  what.shares = shares_of(all.given);
  return what;
}

void TeamMember::send_proposal() {
  if (!proposal_ || proposal_->rejected || now_ < proposal_->next) return;
  const double period = times().query_period;
  proposal_->next = now_ + (proposal_->seen ? kRemind * period : period);
  if (!proposal_->seen && proposal_->quick > 0) {
    --proposal_->quick;
    proposal_->next = now_ + repeat_after();
  }
  for (const EntityId id : config_.operators) {
    const auto* station = contacts_.find(id);
    if (id != self_ && station && now_ - station->heard <= follower_lost_after())
      send_one(id, said(*proposal_, AllocationState::kWaits));
  }
}

void TeamMember::on(EntityId from, const TeamDecision& decision) {
  if (role_ != Role::kLeading) return;  // the station will hear of that
  if (!config_.approval || !is_desk(from))
    return report(EventKind::kTeamAnswerRefused,
                  fmt::format("{} has nothing to approve.", from.value), {.other = from});
  settle(from, decision);
}

// However often it comes, it counts once, and is answered each time.
void TeamMember::settle(EntityId from, const TeamDecision& decision) {
  const bool is_present = proposal_ && proposal_->number == decision.number;
  if (decision.answer == TeamAnswer::kTaken) {
    if (!proposal_ || decision.number < proposal_->number ||
        decision.number >= kMaxProposalNumber)
      return;
    withdraw();
    proposals_ = decision.number;
    changed_ = true;
    return;
  }
  if (decision.answer == TeamAnswer::kSeen) {
    if (!is_present || proposal_->seen) return;
    proposal_->seen = true;
    proposal_->next = now_ + kRemind * times().query_period;
    return;
  }
  if (is_present && decision.answer == TeamAnswer::kApprove && !proposal_->rejected) {
    put_in_force();
  } else if (is_present && !proposal_->rejected) {
    proposal_->rejected = true;
    last_settled_ = {decision.number, AllocationState::kRejected};
    note_allocation(AllocationState::kRejected, decision.number, proposal_->allocated);
  }
  const AllocationState state = last_settled_.first == decision.number
                                    ? last_settled_.second
                                    : AllocationState::kWithdrawn;
  if (from == self_) return end_shown(self_, state, "");
  send_one(from, TeamProposal{*mission_, decision.number, state});
}

// Without tasks and members that are gone meanwhile.
void TeamMember::put_in_force() {
  const auto tasks = open_tasks();
  const auto ids = ids_in(workers());
  TeamAllocated approved = std::move(proposal_->allocated);
  approved.given = left_of(approved.given, numbers_in(tasks), ids);
  for (const EntityId id : ids) {
    const auto given = approved.given.find(id);
    in_force_[id] =
        given == approved.given.end() ? std::vector<std::uint32_t>{} : given->second;
  }
  for (const auto& [id, given] : approved.given)
    for (const std::uint32_t task : given) knowledge_.tasks.at(task).released = true;
  last_settled_ = {proposal_->number, AllocationState::kApproved};
  note_allocation(AllocationState::kApproved, proposal_->number, approved);
  proposal_.reset();
  order_what_is_in_force();
}

void TeamMember::order_what_is_in_force() {
  const auto tasks = open_tasks();
  for (const EntityId id : member_ids()) {
    const auto given = in_force_.find(id);
    orders_.set(id, given == in_force_.end() ? std::vector<std::uint32_t>{}
                                             : orderable(given->second, tasks));
  }
}

void TeamMember::withdraw() {
  if (proposal_ && !proposal_->rejected) {
    note_allocation(AllocationState::kWithdrawn, proposal_->number, proposal_->allocated);
    const TeamProposal what = said(*proposal_, AllocationState::kWithdrawn);
    if (is_desk(self_))
      end_shown(self_, AllocationState::kWithdrawn, "tasks or members have changed");
    for (const EntityId id : config_.operators)
      if (id != self_) repeat(id, what, kWithdrawRepeats);
  }
  proposal_.reset();
}

void TeamMember::note_allocation(AllocationState state, std::uint32_t number,
                                 const TeamAllocated& allocated) {
  TeamAllocationReport said;
  said.team = name_of(*mission_);
  said.proposer = self_;
  said.number = number;
  said.state = state;
  said.value = allocated.value;
  said.bound = allocated.bound;
  if (said.value && said.bound) {
    const double larger = std::max(std::abs(*said.value), std::abs(*said.bound));
    said.gap = larger > 0 ? std::max(0.0, *said.bound - *said.value) / larger : 0;
  }
  said.shares = shares_of(allocated.given);
  out_->allocations.push_back(std::move(said));
}

}  // namespace skein::reasoning
