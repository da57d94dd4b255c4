// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "skein/layer/reasoning/team/protocol/team_member.h"

namespace skein::reasoning {
namespace {

// Whether it says that it executes a task, and is not done with it.
bool executes(const TeamInform& inform, std::uint32_t task) {
  return std::ranges::any_of(inform.tasks, [task](const TeamProgress& progress) {
    return progress.task == task && progress.share < 1;
  });
}

}  // namespace

void TeamMember::receive(const TeamReceived& received) {
  // Of a team that is not known yet all senders count.
  const double period = follower_period(times(), contacts_.all().size() + 1);
  const double silence = lost_ + period - times().query_period;
  const double absence = lost_ * period / times().query_period;
  const TeamVerdict verdict = contacts_.take(received.from, received.to_all,
                                             received.message, now_, {silence, absence});
  if (verdict == TeamVerdict::kRepeated || verdict == TeamVerdict::kLate) return;
  if (verdict != TeamVerdict::kNew) return refuse(received, verdict);
  if (contacts_.restarted()) orders_from_.erase(received.from);
  std::visit([&](const auto& content) { on(received.from, content); },
             received.message.content);
}

// Said once in a while: whoever floods with bad messages does not flood the records.
void TeamMember::refuse(const TeamReceived& received, TeamVerdict verdict) {
  double& last = refused_.try_emplace({received.from, verdict}, -1e300).first->second;
  if (now_ - last < 10 * times().query_period) return;
  last = now_;
  report(event_of(verdict),
         fmt::format("a {} of {} changes nothing.", kind_of(received.message.content),
                     received.from.value),
         {.other = received.from});
}

void TeamMember::on(EntityId from, const TeamQuery& query) {
  if (!query.mission) {
    if (role_ == Role::kLeading) send_one(from, own_inform());
    return;
  }
  if (!mission_ || mission_->name != query.mission->name || role_ == Role::kAlone) return;
  const bool fixed = config_.structure == TeamStructure::kFixedMaster;
  if (fixed && config_.fixed_master != from) return;
  if (role_ == Role::kFollowing) return query_as_follower(from, query);
  // A station without a team of its own is of no branch.
  const bool leads_nobody =
      role_ == Role::kLeading && followers_.empty() && is_operator(self_);
  if (role_ == Role::kSelecting || (leads_nobody && is_sibling(query.mission))) {
    if (!may_follow(query.mission)) return;
    follow(from, from == chosen_ ? TeamReason::kSelected : TeamReason::kFollowing);
    return query_as_follower(from, query);
  }
  if (is_sibling(query.mission)) return heard_sibling(*query.mission->branch);
  if (query.successor == self_) return;
  if (successor_ == from) return follow(from, TeamReason::kHandover);
  meet(from, query);
}

void TeamMember::query_as_follower(EntityId from, const TeamQuery& query) {
  if (from == master_) {
    evidence_ = direct_ = now_;
    evidence_number_ = contacts_.find(from)->query_number;
    round_trip_ = query.round_trip;
    if (mission_ != query.mission) {
      mission_ = query.mission;
      set_status(TeamReason::kSplit);
    }
    announced_ = query.successor;
    if (announced_ == self_) lead(TeamReason::kHandover, from);
    return;
  }
  if (!is_of_lineage(query.mission)) return;
  regrouped_ = now_;  // two teams have met: both masters have to know of all members
  if (announced_ == from) return follow(from, TeamReason::kHandover);
  // Others have lost the master a little earlier. Who has led for long took over in
  // another part of the team.
  const bool silent = now_ - evidence_ > 2 * times().query_period;
  const bool just_now = query.led < lost_ + round_trip_;
  if (query.predecessor == master_ && silent && just_now)
    follow(from, TeamReason::kSelected);
}

void TeamMember::on(EntityId from, const TeamInform& inform) {
  compare_executing(from, inform);
  take(from, inform);
}

// Two execute one task. Where the master of both receives only one of them, it has given
// that one the task of the other, whom it has lost. Of two masters that do not receive
// each other the lower one's member flies on; who leads says nothing of its own task, so
// it is the one who drops it.
void TeamMember::compare_executing(EntityId from, const TeamInform& inform) {
  std::erase_if(twice_, [&](const auto& each) {
    return each.second == from && !(executes(inform, each.first) && flies(each.first));
  });
  const auto& own = status_.master;
  if (!is_of_lineage(inform.mission) || !inform.master || !own) return;
  const auto* master = contacts_.find(*own);
  const bool superseded = role_ == Role::kFollowing && inform.master == own &&
                          from != *own && master &&
                          now_ - direct_ > kSilent * times().query_period &&
                          inform.query > master->query_number;
  const bool yields =
      role_ == Role::kLeading ? inform.master != own : inform.master < own;
  std::vector<std::uint32_t> left;
  for (const std::uint32_t task : executing_) {
    const auto known = knowledge_.tasks.find(task);
    const bool single = known != knowledge_.tasks.end() && known->second.single;
    if (!single || !executes(inform, task)) {
      left.push_back(task);
      continue;
    }
    if (twice_.insert({task, from}).second)
      report(EventKind::kTeamTaskTwice,
             fmt::format("{} executes task {} too.", from.value, task),
             {.other = from, .team_task = task});
    if (yields) yielded_[task] = from;
    if (!superseded && !yields) left.push_back(task);
  }
  if (left.size() == executing_.size()) return;
  report(superseded ? EventKind::kTeamOrderSuperseded : EventKind::kTeamTaskYielded,
         fmt::format("what {} executes too is dropped.", from.value), {.other = from});
  set_executing(std::move(left));
}

bool TeamMember::flies(std::uint32_t task) const {
  return std::ranges::find(executing_, task) != executing_.end();
}

// What it leaves to another team it refuses, as long as it receives that this executes
// it.
void TeamMember::refuse_yielded() {
  std::erase_if(yielded_, [&](const auto& each) {
    const auto* other = contacts_.find(each.second);
    return !other || now_ - other->informed > follower_lost_after() ||
           other->inform.master == status_.master || !executes(other->inform, each.first);
  });
  resources_.refused = refused_by_task_;
  for (const auto& [task, other] : yielded_)
    if (!refuses(resources_, task)) resources_.refused.push_back(task);
}

void TeamMember::take(EntityId from, const TeamInform& inform) {
  if (!mission_ || !inform.mission || inform.mission->name != mission_->name) return;
  if (is_operator(self_)) inform_as_station(from, inform);
  if (role_ == Role::kFollowing) return inform_as_follower(from, inform);
  if (role_ == Role::kLeading) inform_as_master(from, inform);
  if (takes_part_in_auction()) take_progress(inform);
}

void TeamMember::on(EntityId from, const TeamHere& here) {
  const auto* contact = contacts_.find(from);
  // The master follows somebody else, and all that said so in full was lost.
  const bool follows = contact && contact->leads && here.master && *here.master != from &&
                       *here.master != self_;
  if (follows && role_ == Role::kFollowing && from == master_)
    return follow(*here.master, TeamReason::kMerged);
  if (contact && !contact->leads && contact->informed == now_)
    take(from, contact->inform);
}

void TeamMember::inform_as_follower(EntityId from, const TeamInform& inform) {
  if (!is_of_lineage(inform.mission)) return;
  if (from == master_) {
    if (!inform.master || *inform.master == from) return;
    if (*inform.master != self_)
      return follow(*inform.master,
                    inform.leaving ? TeamReason::kHandover : TeamReason::kMerged);
    // Each follows the other: somebody must lead.
    if (self_ < from || inform.leaving) lead(TeamReason::kMerged, from);
    return;
  }
  // Others have heard the master meanwhile: it is there, only its messages to here are
  // lost. Not for ever: who does not hear it gets no orders.
  if (inform.master != master_ || inform.query <= evidence_number_ ||
      (now_ - direct_ > 3 * lost_ && !is_operator(self_)))
    return;
  evidence_number_ = inform.query;
  evidence_ = std::max(evidence_, now_ - inform.held);
}

void TeamMember::on(EntityId from, const TeamAssign& assign) {
  const bool chosen =
      role_ == Role::kSelecting && chosen_ == from && is_of_lineage(assign.mission);
  if (chosen) follow(from, TeamReason::kSelected);
  if (role_ != Role::kFollowing || master_ != from || !is_of_lineage(assign.mission)) {
    // Common after a change of master; of anybody else it is forged.
    return report(EventKind::kTeamOrderRefused,
                  fmt::format("{} does not lead here.", from.value), {.other = from});
  }
  std::uint32_t& last = orders_from_[from];
  if (assign.number < last) return;  // an older one that was repeated
  last = assign.number;
  order_of_ = from;
  order_until_.reset();
  // What is done is not flown again, though the master does not know yet.
  std::vector<std::uint32_t> tasks;
  for (const TeamTask& task : assign.tasks) {
    const auto& known = knowledge_.tasks.try_emplace(task.number, task).first->second;
    if (!known.done && !has_done(task.number) && !yielded_.contains(task.number))
      tasks.push_back(task.number);
  }
  if (tasks.size() < assign.tasks.size()) {
    informs_ = kInformRepeats;
    next_inform_ = now_;
  }
  knowledge_.compare(assign.tasks);
  set_executing(std::move(tasks));
  send_one(from, TeamAssignAck{assign.number});
}

void TeamMember::on(EntityId from, const TeamAssignAck& ack) {
  if (role_ != Role::kLeading) return;
  if (!orders_.acknowledge(from, ack.number))
    return report(EventKind::kTeamAnswerRefused,
                  fmt::format("{} answers an order that there was not.", from.value),
                  {.other = from});
  const auto follower = followers_.find(from);
  if (follower != followers_.end()) follower->second.claimed = now_;
}

void TeamMember::state_as_follower(EntityId from, const TeamState& state) {
  const auto* contact = contacts_.find(from);
  if (!contact) return;
  // Others of its team pass on to a station what the master says.
  if (is_operator(self_) && from != master_ && is_of_lineage(contact->inform.mission))
    knowledge_.add(state, std::nullopt);
  if (from != master_ || !contact->leads) return;
  if (state.number == contact->query.state_number) knowledge_.take(state);
  if (hash_of_members(state.members) != contact->query.members_hash) return;
  members_ = state.members;
  set_status(TeamReason::kMembers);
}

// Another master of the mission that gives way may, who is with an operator, and
// followers what they say to know; of those without a master all of one mission.
bool TeamMember::may_add_tasks(EntityId from, const TeamState& state) const {
  const auto* contact = contacts_.find(from);
  if (!contact) return false;
  if (takes_part_in_auction()) return is_of_lineage(contact->inform.mission);
  if (contact->leads) return is_of_lineage(contact->query.mission);
  if (!followers_.contains(from)) return false;
  return is_operator(from) || (contact->inform.master == self_ &&
                               contact->inform.state_number == state.number);
}

void TeamMember::on(EntityId from, const TeamState& state) {
  if (role_ == Role::kFollowing) return state_as_follower(from, state);
  // In an auction nobody has to take newcomers: they take part from when they hear of it.
  if (role_ == Role::kNewcomer && config_.structure == TeamStructure::kAuction)
    if (const auto* contact = contacts_.find(from); contact && contact->inform.mission)
      submit(contact->inform.mission->name, {}, time_);
  const bool adds = role_ == Role::kLeading || takes_part_in_auction();
  const auto* sender = contacts_.find(from);
  if (role_ == Role::kLeading && sender && sender->leads &&
      is_sibling(sender->query.mission)) {
    changed_ |= knowledge_.add_of_branch(state, *sender->query.mission->branch,
                                         *mission_->branch);
    return;
  }
  if (!adds || !may_add_tasks(from, state)) return;
  TeamState added = state;
  // What it knew alone when the mission was split is its own.
  if (split_with_.contains(from))
    std::erase_if(added.tasks, [&](const TeamTask& task) {
      return !knowledge_.tasks.contains(task.number);
    });
  if (knowledge_.add(added, mission_ ? mission_->branch : std::nullopt)) changed_ = true;
}

void TeamMember::on(EntityId from, const TeamBids& bids) {
  (void)from;
  if (role_ == Role::kAlone && mission_ && bids.mission == *mission_)
    auction_.take(self_, bids);
}

}  // namespace skein::reasoning
