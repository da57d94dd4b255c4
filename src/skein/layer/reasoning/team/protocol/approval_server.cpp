// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/approval_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace skein::reasoning {

std::string ApprovalServer::decide(const TeamConfig& config, std::uint32_t number,
                                   bool approve) {
  if (!config.approval) return "allocations of this team need no approval.";
  if (shown_.empty()) return "none waits for approval.";
  if (number == 0 && shown_.size() > 1) return "several wait: say which number.";
  const auto found = std::ranges::find_if(shown_, [&](const auto& shown) {
    return number == 0 || shown.second.proposal.number == number;
  });
  if (found == shown_.end())
    return fmt::format("{} does not wait, {} does.", number,
                       shown_.begin()->second.proposal.number);
  Shown& shown = found->second;
  const TeamAnswer answer = approve ? TeamAnswer::kApprove : TeamAnswer::kReject;
  if (shown.decision && *shown.decision != answer)
    return fmt::format("{} has been decided, {} is being told.", shown.proposal.number,
                       member_name(config, found->first));
  if (!shown.decision) shown.next = 0;
  shown.decision = answer;
  return "";
}

void ApprovalServer::show(MemberState& member, EntityId proposer,
                          const TeamProposal& proposal) {
  end(member, proposer, AllocationState::kWithdrawn, "another one is proposed");
  shown_[proposer] = {proposal};
  last_number_[proposer] = proposal.number;
  highest_number_ = std::max(highest_number_, proposal.number);
  member.outbox.report(EventKind::kAllocationProposed,
                       text_of(member.config, proposer, proposal),
                       {.other = proposer, .value = proposal.number});
}

void ApprovalServer::end(MemberState& member, EntityId proposer, AllocationState state,
                         const char* why) {
  const auto shown = shown_.find(proposer);
  if (shown == shown_.end()) return;
  const std::string_view what =
      state == AllocationState::kApproved ? "in force" : name_of(state);
  member.outbox.report(EventKind::kAllocationOver,
                       fmt::format("{} of {} is {}{}{}", shown->second.proposal.number,
                                   member_name(member.config, proposer), what,
                                   *why == '\0' ? "" : ": ", why),
                       {.other = proposer, .value = shown->second.proposal.number});
  shown_.erase(shown);
}

void ApprovalServer::on(MemberState& member, EntityId from,
                        const TeamProposal& proposal) {
  const auto* contact = member.contacts.find(from);
  const bool leads = contact && (contact->leads || member.leader.id == from);
  if (!member.approves(member.self) || !member.config.approval || !leads ||
      !member.mission || proposal.mission.name != member.mission->name)
    return member.outbox.report(
        EventKind::kTeamOrderRefused,
        fmt::format("{} has nothing to propose here.", from.value), {.other = from});
  const auto shown = shown_.find(from);
  const bool is_shown =
      shown != shown_.end() && shown->second.proposal.number == proposal.number;
  if (proposal.state != AllocationState::kWaits) {
    if (is_shown) end(member, from, proposal.state, "");
    return;
  }
  const auto last = last_number_.find(from);
  const bool again = last != last_number_.end() && last->second == proposal.number;
  if (!again && proposal.number <= highest_number_)
    return member.outbox.send(from, TeamDecision{highest_number_, TeamAnswer::kTaken});
  if (!is_shown) show(member, from, proposal);
  if (!shown_.at(from).decision)
    member.outbox.send(from, TeamDecision{proposal.number, TeamAnswer::kSeen});
}

// A proposal ends with the lead of its proposer.
void ApprovalServer::end_of_lost(MemberState& member) {
  std::vector<EntityId> lost;
  for (const auto& [proposer, shown] : shown_) {
    const auto* contact = member.contacts.find(proposer);
    if (proposer != member.self &&
        (!contact || !contact->leads ||
         member.now - contact->heard > member.lost + member.exchange_time()))
      lost.push_back(proposer);
  }
  for (const EntityId proposer : lost) {
    const TeamProposal proposal = shown_.at(proposer).proposal;
    end(member, proposer, AllocationState::kWithdrawn, "its proposer is lost or follows");
    TeamAllocationReport said;
    said.team = name_of(proposal.mission);
    said.proposer = proposer;
    said.number = proposal.number;
    said.state = AllocationState::kWithdrawn;
    said.shares = proposal.shares;
    member.outbox.report(std::move(said));
  }
}

std::vector<std::pair<EntityId, TeamDecision>> ApprovalServer::step(MemberState& member) {
  end_of_lost(member);
  std::vector<std::pair<EntityId, TeamDecision>> due;
  for (auto& [proposer, shown] : shown_) {
    if (!shown.decision || member.now < shown.next) continue;
    shown.next =
        member.now + std::max(member.repeat_after(), member.times().query_period);
    due.emplace_back(proposer, TeamDecision{shown.proposal.number, *shown.decision});
  }
  return due;
}

}  // namespace skein::reasoning
