// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/leading.h"

#include <fmt/format.h>

#include <algorithm>

namespace skein::reasoning {
namespace {

constexpr std::uint32_t kStateEvery = 5;     // queries, when nobody lags behind
constexpr std::uint32_t kPartsInPeriod = 2;  // of the state

void refuse_answer(MemberState& member, EntityId from, const char* why) {
  member.outbox.report(EventKind::kTeamAnswerRefused,
                       fmt::format("{} {}.", from.value, why), {.other = from});
}

}  // namespace

void TeamLeading::begin(MemberState& member, const LeadTeam& how) {
  led_since_ = member.now;
  predecessor_ = how.predecessor;
  successor_.reset();
  encounters_.clear();
  branches_.clear();
  allocator_.begin();
  followers_.begin(member);
  member.outbox.report(
      EventKind::kTeamSelected,
      fmt::format("{} leads ({}).", member.self.value, name_of(how.reason)));
  // Who has lost its leader says more often that it is there.
  const double holds =
      how.reason == TeamReason::kSelected ? member.lost : member.follower_lost_after();
  for (const auto& [id, contact] : member.contacts.all()) {
    const auto& leader = contact.inform.master;
    const bool is_free = !leader || leader == predecessor_ || leader == member.self;
    if (member.is_of_lineage(contact.inform.mission) && is_free && !contact.leads &&
        member.now - contact.informed <= holds)
      followers_.add(member, id, false, "heard");
  }
  if (how.reason == TeamReason::kHandover && predecessor_)
    followers_.add(member, *predecessor_, false, "handed over");
  member.allocation_due = true;
  member.next_query = member.now;
  member.set_status(how.reason);
}

void TeamLeading::end(MemberState& member, ProposalDisplay& display) {
  allocator_.end(member, display);
  followers_.clear();
  encounters_.clear();
  branches_.clear();
}

void TeamLeading::step(MemberState& member, ProposalDisplay& display) {
  followers_.drop_silent(member);
  branches_.step(member);
  hand_over(member);
  encounters_.step(member);
  member.finish_own();
  allocator_.look(member);
  if (member.allocation_due && !encounters_.is_held(member) &&
      !encounters_.waits_for_split()) {
    allocator_.allocate(member, display, branches_.open_tasks(member),
                        followers_.workers(member));
    order_what_is_in_force(member);
  }
  allocator_.send_proposal(member);
  followers_.give_orders(member);
  member.set_status(TeamReason::kMembers);
}

void TeamLeading::order_what_is_in_force(MemberState& member) {
  followers_.set_orders(member, allocator_.in_force(), branches_.open_tasks(member));
}

void TeamLeading::hand_over(MemberState& member) {
  if (!member.leaves()) return;
  if (successor_ && member.now - successor_since_ <= member.exchange_time()) return;
  const auto candidates = followers_.candidates(member, successor_);
  if (candidates.empty()) return;
  // A station that has found its team waits a moment until all of it may be chosen.
  if (member.is_operator(member.self) && candidates.size() < followers_.size() &&
      member.now - led_since_ <= 2 * member.exchange_time())
    return;
  successor_ = member.config.select(candidates);
  successor_since_ = member.now;
  member.next_query = member.now;
  member.outbox.report(EventKind::kTeamHandover,
                       fmt::format("{} shall lead.", successor_->value),
                       {.other = successor_});
  send_knowledge(member);
}

void TeamLeading::send_query(MemberState& member) {
  TeamQuery query;
  query.mission = member.mission;
  query.members = static_cast<std::uint32_t>(member.members.size());
  query.members_hash = hash_of_members(member.members);
  query.state_number = member.knowledge.number();
  query.led = static_cast<float>(member.now - led_since_);
  query.round_trip = static_cast<float>(member.round_trip);
  query.successor = successor_;
  query.predecessor = predecessor_;
  followers_.note_query(member.outbox.send_all(query), member.now);

  const bool lags = followers_.lag_behind(member, query);
  const bool is_received = !followers_.empty() || branches_.receives_any(member);
  if (!is_received || (!lags && queries_++ % kStateEvery != 0)) return;
  for (std::uint32_t part = 0; part < std::min(kPartsInPeriod, member.knowledge.parts());
       ++part)
    member.outbox.send_all(member.knowledge.next_part(member.members));
}

TeamTransition TeamLeading::on(MemberState& member, EntityId from,
                               const TeamQuery& query) {
  if (member.is_sibling(query.mission)) {
    branches_.received(*query.mission->branch, member.now);
    return {};
  }
  if (query.successor == member.self) return {};
  if (successor_ == from) return FollowOther{from, TeamReason::kHandover};
  return encounters_.meet(member, from, query, led_since_, branches_);
}

void TeamLeading::on(MemberState& member, EntityId from, const TeamInform& inform) {
  if (member.is_sibling(inform.mission))
    return branches_.received(*inform.mission->branch, member.now);
  if (inform.master == member.self) {
    encounters_.forget(from);
    followers_.confirmed(member, from, inform);
  } else if (inform.master) {
    const bool hands_on =
        followers_.contains(*inform.master) || inform.master == predecessor_;
    followers_.follows_other(member, from, *inform.master, hands_on);
  }
}

void TeamLeading::on(MemberState& member, EntityId from, const TeamPropose& propose) {
  const auto tasks = branches_.open_tasks(member);
  if (member.config.admit &&
      !member.config.admit(propose.resources, tasks, followers_.workers(member)))
    return member.outbox.send(from, TeamReject{propose.exchange});
  double nearest = 0;
  for (const TeamTask& task : tasks) {
    const double distance =
        (task.place - geo::horizontal(propose.resources.place)).norm();
    nearest = &task == &tasks.front() ? distance : std::min(nearest, distance);
  }
  accepted_[from] = propose.exchange;
  member.outbox.send(from, TeamAccept{propose.exchange, *member.mission, nearest,
                                      static_cast<std::uint32_t>(followers_.size() + 1)});
}

void TeamLeading::on(MemberState& member, EntityId from, const TeamConfirm& confirm) {
  const auto accepted = accepted_.find(from);
  if (accepted == accepted_.end() || accepted->second != confirm.exchange)
    return refuse_answer(member, from, "was not accepted");
  followers_.add(member, from, false, "it has joined");
}

void TeamLeading::on(MemberState& member, EntityId from, const TeamDecline&) {
  followers_.declined(member, from);
}

void TeamLeading::on(MemberState& member, EntityId from, const TeamAssignAck& ack) {
  followers_.on(member, from, ack);
}

// Another leader of the mission may that gives way, who is with an operator, and
// followers what they say to know.
bool TeamLeading::may_add_tasks(const MemberState& member, EntityId from,
                                const TeamState& state) const {
  const auto* contact = member.contacts.find(from);
  if (!contact) return false;
  if (contact->leads) return member.is_of_lineage(contact->query.mission);
  if (!followers_.contains(from)) return false;
  return member.is_operator(from) || (contact->inform.master == member.self &&
                                      contact->inform.state_number == state.number);
}

void TeamLeading::on(MemberState& member, EntityId from, const TeamState& state) {
  const auto* sender = member.contacts.find(from);
  if (sender && sender->leads && member.is_sibling(sender->query.mission)) {
    member.allocation_due |= member.knowledge.add_of_branch(
        state, *sender->query.mission->branch, *member.mission->branch);
    return;
  }
  if (!may_add_tasks(member, from, state)) return;
  TeamState added = state;
  // What the other one knew alone when the mission was split is its own.
  if (encounters_.has_split_with(from))
    std::erase_if(added.tasks, [&](const TeamTask& task) {
      return !member.knowledge.tasks.contains(task.number);
    });
  member.allocation_due |= member.knowledge.add(added, member.mission->branch);
}

void TeamLeading::on(MemberState& member, EntityId from, const TeamMerge& merge) {
  if (!member.is_of_lineage(merge.mission)) {
    if (!merge.split || !member.is_sibling(merge.mission))
      refuse_answer(member, from, "is of another mission");
    return;
  }
  const auto* sender = member.contacts.find(from);
  // Who gives way may have said already that it follows.
  const bool led =
      sender && (sender->leads || (!merge.split && sender->inform.master == member.self));
  if (!led) return refuse_answer(member, from, "led no team");
  if (merge.split)
    return encounters_.answer_split(member, from, merge, branches_.open_tasks(member),
                                    followers_.workers(member), branches_);
  take_in_team(member, from, merge);
}

void TeamLeading::take_in_team(MemberState& member, EntityId from,
                               const TeamMerge& merge) {
  member.knowledge.note(merge.meeting);
  encounters_.forget(from);
  // Their tasks are part of this one's, when either was a branch.
  if (!member.mission->branch && merge.mission.branch) member.mission = merge.mission;
  bool is_new = false;
  std::vector<EntityId> all = merge.members;
  all.push_back(from);
  for (const EntityId id : all) {
    const auto* contact = member.contacts.find(id);
    if (id == member.self || followers_.contains(id) || !contact ||
        member.now - contact->heard > member.follower_lost_after())
      continue;
    followers_.add(member, id, false, "merged");
    is_new = true;
  }
  if (!is_new) return;
  member.outbox.report(EventKind::kTeamMerged,
                       fmt::format("with the team of {}.", from.value), {.other = from});
  member.set_status(TeamReason::kMerged);
}

void TeamLeading::on(MemberState& member, EntityId from, const TeamSplit& split) {
  encounters_.on(member, from, split, branches_);
}

void TeamLeading::on(MemberState& member, EntityId from, const TeamDecision& decision,
                     ProposalDisplay& display) {
  if (!member.config.approval || !member.approves(from))
    return refuse_answer(member, from, "has nothing to approve");
  if (allocator_.settle(member, display, from, decision, branches_.open_tasks(member),
                        followers_.workers(member)))
    order_what_is_in_force(member);
}

}  // namespace skein::reasoning
