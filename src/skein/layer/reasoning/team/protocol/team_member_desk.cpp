// SPDX-License-Identifier: Apache-2.0
// How the station of an operator approves what a master proposes.
#include <fmt/format.h>

#include <algorithm>

#include "skein/layer/reasoning/team/protocol/team_member.h"

namespace skein::reasoning {

std::string TeamMember::name(EntityId id) const {
  const auto known = config_.names.find(id);
  return known == config_.names.end() ? fmt::format("{}", id.value) : known->second;
}

std::string TeamMember::text_of(EntityId proposer, const TeamProposal& proposal) const {
  std::string text = fmt::format("{} of {}:", proposal.number, name(proposer));
  for (const TeamShare& share : proposal.shares)
    text += fmt::format("{} {} flies {}", &share == proposal.shares.data() ? "" : ",",
                        name(share.member), share.task);
  if (proposal.shares.empty()) text += " nobody flies";
  if (proposal.value && proposal.bound)
    text += fmt::format(" (utility {:.2f} of at most {:.2f})", *proposal.value,
                        *proposal.bound);
  return text;
}

std::string TeamMember::decide(std::uint32_t number, bool approve) {
  if (!config_.approval) return "allocations of this team need no approval.";
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
                       name(found->first));
  if (!shown.decision) shown.next = 0;
  shown.decision = answer;
  return "";
}

void TeamMember::show(EntityId proposer, const TeamProposal& proposal) {
  if (shown_.contains(proposer))
    end_shown(proposer, AllocationState::kWithdrawn, "another one is proposed");
  shown_[proposer] = {proposal};
  last_shown_[proposer] = proposal.number;
  highest_shown_ = std::max(highest_shown_, proposal.number);
  report(EventKind::kAllocationProposed, text_of(proposer, proposal),
         {.other = proposer, .value = proposal.number});
}

void TeamMember::end_shown(EntityId proposer, AllocationState state, const char* why) {
  const auto shown = shown_.find(proposer);
  if (shown == shown_.end()) return;
  const std::string_view what =
      state == AllocationState::kApproved ? "in force" : name_of(state);
  const std::uint32_t number = shown->second.proposal.number;
  report(EventKind::kAllocationOver,
         fmt::format("{} of {} is {}{}{}", number, name(proposer), what,
                     *why == '\0' ? "" : ": ", why),
         {.other = proposer, .value = number});
  shown_.erase(shown);
}

void TeamMember::on(EntityId from, const TeamProposal& proposal) {
  const auto* contact = contacts_.find(from);
  const bool leads = contact && (contact->leads || master_ == from);
  if (!is_desk(self_) || !config_.approval || !leads || !mission_ ||
      proposal.mission.name != mission_->name)
    return report(EventKind::kTeamOrderRefused,
                  fmt::format("{} has nothing to propose here.", from.value),
                  {.other = from});
  const auto shown = shown_.find(from);
  const bool is_shown =
      shown != shown_.end() && shown->second.proposal.number == proposal.number;
  if (proposal.state != AllocationState::kWaits) {
    if (is_shown) end_shown(from, proposal.state, "");
    return;
  }
  const auto last = last_shown_.find(from);
  const bool again = last != last_shown_.end() && last->second == proposal.number;
  if (!again && proposal.number <= highest_shown_)
    return send_one(from, TeamDecision{highest_shown_, TeamAnswer::kTaken});
  if (!is_shown) show(from, proposal);
  if (!shown_.at(from).decision)
    send_one(from, TeamDecision{proposal.number, TeamAnswer::kSeen});
}

// Decisions are repeated until the proposer says what has become of them; a proposal ends
// with the lead of its proposer.
void TeamMember::step_shown() {
  std::vector<EntityId> lost;
  for (auto& [proposer, shown] : shown_) {
    const auto* contact = contacts_.find(proposer);
    if (proposer != self_ &&
        (!contact || !contact->leads || now_ - contact->heard > lost_ + exchange_time()))
      lost.push_back(proposer);
  }
  for (const EntityId proposer : lost) {
    const TeamProposal proposal = shown_.at(proposer).proposal;
    end_shown(proposer, AllocationState::kWithdrawn, "its proposer is lost or follows");
    TeamAllocationReport said;
    said.team = name_of(proposal.mission);
    said.proposer = proposer;
    said.number = proposal.number;
    said.state = AllocationState::kWithdrawn;
    said.shares = proposal.shares;
    out_->allocations.push_back(std::move(said));
  }
  std::vector<std::pair<EntityId, TeamDecision>> due;
  for (auto& [proposer, shown] : shown_) {
    if (!shown.decision || now_ < shown.next) continue;
    shown.next = now_ + std::max(repeat_after(), times().query_period);
    due.emplace_back(proposer, TeamDecision{shown.proposal.number, *shown.decision});
  }
  for (const auto& [proposer, decision] : due) {
    if (proposer == self_)
      settle(self_, decision);
    else
      send_one(proposer, decision);
  }
}

}  // namespace skein::reasoning
