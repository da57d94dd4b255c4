// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/election.h"

#include <algorithm>
#include <vector>

namespace skein::reasoning {
namespace {

constexpr double kFirstPeriods = 10;  // query periods before the first leader is elected
constexpr double kMaxTravel = 8;      // [s] that the first messages may take
// Members that went silent together with the leader were received as long as it was, but
// for the jitter of their messages.
constexpr double kPeriodsAfterLeader = 1.5;  // query periods

}  // namespace

void TeamElection::reset() {
  chosen_.reset();
  passed_over_.clear();
}

TeamTransition TeamElection::first(const MemberState& member) {
  if (member.role != TeamRole::kSelecting) return {};
  if (member.config.structure == TeamStructure::kFixedMaster &&
      member.config.fixed_leader == member.self)
    return LeadTeam{TeamReason::kFixed};
  if (member.is_operator(member.self) && !member.leader.id)
    return LeadTeam{TeamReason::kAlone};
  return {};
}

TeamTransition TeamElection::step(const MemberState& member, bool may_lead_alone) {
  const double now = member.now, period = member.times().query_period;
  const std::optional<EntityId>& lost_leader = member.leader.id;
  // At the start nothing can have been received before it has travelled.
  const double travel = member.contacts.all().empty() ? kMaxTravel : 0;
  const double first = lost_leader ? 0 : kFirstPeriods * period;
  if (now - member.leader.evidence <= std::max(member.lost, first) + travel) return {};
  if (member.config.structure == TeamStructure::kFixedMaster) return {};  // it waits
  std::vector<EntityId> candidates;
  const double from = member.leader.evidence + kPeriodsAfterLeader * period;
  for (const auto& [id, contact] : member.contacts.all()) {
    const TeamInform& said = contact.inform;
    const bool is_free =
        !said.master || said.master == lost_leader || said.master == member.self;
    if (contact.informed > from && now - contact.informed <= member.lost && is_free &&
        !said.leaving && member.is_of_lineage(said.mission) && !passed_over_.contains(id))
      candidates.push_back(id);
  }
  if (!member.leaves() || (candidates.empty() && may_lead_alone))
    candidates.push_back(member.self);
  if (candidates.empty()) return {};
  std::ranges::sort(candidates);
  const EntityId choice = member.config.select(candidates);
  if (choice != chosen_) {
    chosen_ = choice;
    chosen_since_ = now;
  }
  const double waited = now - chosen_since_;
  if (choice == member.self) {
    if (waited >= kPeriodsAfterLeader * period)
      return LeadTeam{TeamReason::kSelected, lost_leader};
  } else if (waited > member.exchange_time()) {
    passed_over_.insert(choice);
  }
  return {};
}

}  // namespace skein::reasoning
