// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/approval.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace skein::reasoning {
namespace {

constexpr int kQuickProposals = 3;     // before they come with queries
constexpr double kRemindPeriods = 10;  // query periods, of what the operator is shown
constexpr int kWithdrawals = 3;        // times that it is said

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

}  // namespace

TeamAllocation without_idle(TeamAllocation all) {
  std::erase_if(all, [](const auto& given) { return given.second.empty(); });
  return all;
}

void record_allocation(MemberState& member, AllocationState state, std::uint32_t number,
                       const TeamAllocated& allocated) {
  TeamAllocationReport said;
  said.team = name_of(*member.mission);
  said.proposer = member.self;
  said.number = number;
  said.state = state;
  said.value = allocated.value;
  said.bound = allocated.bound;
  if (said.value && said.bound) {
    const double larger = std::max(std::abs(*said.value), std::abs(*said.bound));
    said.gap = larger > 0 ? std::max(0.0, *said.bound - *said.value) / larger : 0;
  }
  said.shares = shares_of(allocated.given);
  member.outbox.report(std::move(said));
}

// Who is about to hand over leaves that to its successor.
void TeamApproval::propose(MemberState& member, ProposalDisplay& display,
                           std::span<const TeamTask> tasks,
                           std::span<const TeamWorker> workers, TeamAllocated found,
                           TeamAllocation present) {
  auto numbers = numbers_in(tasks);
  auto ids = ids_in(workers);
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
    withdraw(member, display);
  }
  if (found.given == present || member.leaves() || last_number_ >= kMaxProposalNumber)
    return;
  proposal_ = Proposal{++last_number_, std::move(found), std::move(present),
                       std::move(numbers), std::move(ids)};
  proposal_->quick = kQuickProposals;
  record_allocation(member, AllocationState::kWaits, last_number_, proposal_->allocated);
  const TeamProposal what = message_of(member, *proposal_, AllocationState::kWaits);
  member.outbox.report(EventKind::kTeamProposed,
                       text_of(member.config, member.self, what));
  if (member.approves(member.self)) display.show(member, member.self, what);
}

TeamProposal TeamApproval::message_of(const MemberState& member, const Proposal& proposal,
                                      AllocationState state) {
  TeamProposal what{*member.mission, proposal.number, state};
  if (state != AllocationState::kWaits) return what;
  const TeamAllocated& all = proposal.allocated;
  if (all.value) what.value = static_cast<float>(*all.value);
  if (all.bound) what.bound = static_cast<float>(*all.bound);
  what.shares = shares_of(all.given);
  return what;
}

void TeamApproval::send(MemberState& member) {
  if (!proposal_ || proposal_->rejected || member.now < proposal_->next) return;
  const double period = member.times().query_period;
  proposal_->next = member.now + (proposal_->seen ? kRemindPeriods * period : period);
  if (!proposal_->seen && proposal_->quick > 0) {
    --proposal_->quick;
    proposal_->next = member.now + member.repeat_after();
  }
  for (const EntityId id : member.config.operators) {
    const auto* station = member.contacts.find(id);
    if (id != member.self && station &&
        member.now - station->heard <= member.follower_lost_after())
      member.outbox.send(id, message_of(member, *proposal_, AllocationState::kWaits));
  }
}

void TeamApproval::withdraw(MemberState& member, ProposalDisplay& display) {
  if (proposal_ && !proposal_->rejected) {
    record_allocation(member, AllocationState::kWithdrawn, proposal_->number,
                      proposal_->allocated);
    if (member.approves(member.self))
      display.end(member, member.self, AllocationState::kWithdrawn,
                  "tasks or members have changed");
    const TeamProposal what = message_of(member, *proposal_, AllocationState::kWithdrawn);
    for (const EntityId id : member.config.operators)
      if (id != member.self)
        member.outbox.repeat(id, what, kWithdrawals, member.now + member.exchange_time());
  }
  proposal_.reset();
}

std::optional<TeamAllocation> TeamApproval::settle(MemberState& member,
                                                   ProposalDisplay& display,
                                                   EntityId from,
                                                   const TeamDecision& decision,
                                                   std::span<const TeamTask> tasks,
                                                   std::span<const TeamWorker> workers) {
  const bool is_present = proposal_ && proposal_->number == decision.number;
  if (decision.answer == TeamAnswer::kTaken) {
    if (!proposal_ || decision.number < proposal_->number ||
        decision.number >= kMaxProposalNumber)
      return std::nullopt;
    withdraw(member, display);
    last_number_ = decision.number;
    member.allocation_due = true;
    return std::nullopt;
  }
  if (decision.answer == TeamAnswer::kSeen) {
    if (!is_present || proposal_->seen) return std::nullopt;
    proposal_->seen = true;
    proposal_->next = member.now + kRemindPeriods * member.times().query_period;
    return std::nullopt;
  }
  std::optional<TeamAllocation> approved;
  if (is_present && !proposal_->rejected) {
    if (decision.answer == TeamAnswer::kApprove) {
      approved = approve(member, tasks, workers);
    } else {
      proposal_->rejected = true;
      last_settled_ = {decision.number, AllocationState::kRejected};
      record_allocation(member, AllocationState::kRejected, decision.number,
                        proposal_->allocated);
    }
  }
  const AllocationState state = last_settled_.first == decision.number
                                    ? last_settled_.second
                                    : AllocationState::kWithdrawn;
  if (from == member.self)
    display.end(member, member.self, state, "");
  else
    member.outbox.send(from, TeamProposal{*member.mission, decision.number, state});
  return approved;
}

TeamAllocation TeamApproval::approve(MemberState& member, std::span<const TeamTask> tasks,
                                     std::span<const TeamWorker> workers) {
  TeamAllocated approved = std::move(proposal_->allocated);
  approved.given = left_of(approved.given, numbers_in(tasks), ids_in(workers));
  last_settled_ = {proposal_->number, AllocationState::kApproved};
  record_allocation(member, AllocationState::kApproved, proposal_->number, approved);
  proposal_.reset();
  return approved.given;
}

}  // namespace skein::reasoning
