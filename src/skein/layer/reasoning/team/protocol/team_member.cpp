// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/team_member.h"

namespace skein::reasoning {

TeamMember::TeamMember(EntityId self, TeamConfig config)
    : member_(self, std::move(config)), leading_(self) {}

bool TeamMember::submit(const std::string& mission, std::span<const TeamTask> tasks,
                        Time now) {
  const auto& known = member_.mission;
  if (known && (known->name != mission || member_.follows())) return false;
  member_.now = now.seconds();
  take_tasks(mission, tasks);
  return true;
}

void TeamMember::take_tasks(const std::string& mission, std::span<const TeamTask> tasks) {
  auto& known = member_.mission;
  member_.knowledge.submit(tasks);
  for (const TeamTask& task : tasks)
    if (known && !task.branch)
      member_.knowledge.tasks.at(task.number).branch = known->branch;
  member_.allocation_due = true;
  if (known) return;
  known = TeamMission{mission, std::nullopt};
  const TeamStructure structure = member_.config.structure;
  const bool alone =
      structure == TeamStructure::kNone || structure == TeamStructure::kAuction;
  member_.role = alone ? TeamRole::kAlone : TeamRole::kSelecting;
  member_.leader.evidence = member_.leader.received = member_.now;
}

void TeamMember::hand_in(const std::string& mission, std::span<const TeamTask> tasks,
                         Time now) {
  station_.hand_in(tasks);
  submit(mission, tasks, now);
}

bool TeamMember::withdraw_task(std::uint32_t task) {
  return station_.withdraw(member_, task);
}

std::map<std::uint32_t, TeamTask> TeamMember::all_tasks() const {
  return station_.all_tasks(member_.knowledge);
}

std::map<std::uint32_t, EntityId> TeamMember::executors() const {
  constexpr double kForgotten = 3;  // T_lost: a station may be out of reach for a while
  return member_.contacts.executors(member_.now, kForgotten * member_.lost);
}

void TeamMember::set_resources(const TeamResources& resources) {
  member_.own.set_resources(resources);
}

void TeamMember::set_progress(std::uint32_t task, double share) {
  member_.own.set_progress(task, share);
}

void TeamMember::note_heard(EntityId id, Time now) {
  member_.contacts.note_heard(id, now.seconds());
}

std::string TeamMember::decide(std::uint32_t number, bool approve) {
  return server_.decide(member_.config, number, approve);
}

TeamStep TeamMember::step(Time now, std::span<const TeamReceived> received) {
  member_.begin(now);
  const TeamStatus before = member_.status;
  for (const TeamReceived& one : received) receive(one);
  DuplicateTasks::renew_refusals(member_);
  station_.step(member_);
  member_.measure_loss();
  change(TeamElection::first(member_));
  step_role();
  following_.drop_old_order(member_);
  send_decisions();
  if (!member_.own.resources().able) member_.execute({});
  send_periodic();
  member_.outbox.send_repeated(member_.repeat_after());
  TeamStep done = member_.outbox.take();
  done.changed = !(member_.status == before);
  return done;
}

void TeamMember::step_role() {
  switch (member_.role) {
    case TeamRole::kNewcomer:
      return change(joining_.step(member_));
    case TeamRole::kSelecting:
      return elect();
    case TeamRole::kFollowing:
      if (!TeamFollowing::is_leader_lost(member_)) return;
      following_.lose_leader(member_);
      member_.role = TeamRole::kSelecting;
      election_.reset();
      member_.set_status(TeamReason::kLost);
      return elect();
    case TeamRole::kLeading:
      return leading_.step(member_, server_);
    case TeamRole::kAlone:
      return alone_.step(member_);
  }
}

void TeamMember::elect() {
  const bool may_lead_alone =
      !member_.is_operator(member_.self) || TeamStation::is_team_gone(member_);
  change(election_.step(member_, may_lead_alone));
}

void TeamMember::change(const TeamTransition& transition) {
  if (const auto* other = std::get_if<FollowOther>(&transition)) follow(*other);
  if (const auto* how = std::get_if<LeadTeam>(&transition)) lead(*how);
}

void TeamMember::follow(const FollowOther& other) {
  if (leads()) leading_.end(member_, server_);
  member_.outbox.drop_repeated_except_to(other.leader);
  member_.role = TeamRole::kFollowing;
  election_.reset();
  following_.begin(member_, other.leader, other.reason);
}

void TeamMember::lead(const LeadTeam& how) {
  member_.role = TeamRole::kLeading;
  member_.outbox.drop_repeated();
  election_.reset();
  following_.end(member_.self);
  leading_.begin(member_, how);
  station_.add_handed_in(member_);
}

void TeamMember::send_decisions() {
  for (const auto& [proposer, decision] : server_.step(member_)) {
    if (proposer == member_.self)
      leading_.on(member_, proposer, decision, server_);
    else
      member_.outbox.send(proposer, decision);
  }
}

void TeamMember::send_periodic() {
  const bool asks = leads() || member_.role == TeamRole::kNewcomer;
  if (asks && member_.now >= member_.next_query) {
    if (leads())
      leading_.send_query(member_);
    else
      member_.outbox.send_all(TeamQuery{});
    member_.next_query = member_.after(member_.next_query);
  }
  if (leads() || member_.now < member_.next_inform) return;
  presence_.send(member_);
  member_.next_inform = member_.after(member_.next_inform);
  if (member_.follows()) {
    station_.send_handed_in(member_);
    TeamFollowing::send_news(member_);
  }
  alone_.send(member_);
}

void TeamMember::receive(const TeamReceived& received) {
  if (!reception_.accept(member_, received)) return;
  if (member_.contacts.restarted()) following_.forget_orders_of(received.from);
  std::visit([&](const auto& content) { on(received.from, content); },
             received.message.content);
}

void TeamMember::on(EntityId from, const TeamQuery& query) {
  if (!query.mission) {  // a newcomer looks for leaders
    if (leads()) member_.outbox.send(from, member_.inform());
    return;
  }
  const bool is_ours = member_.mission && member_.mission->name == query.mission->name;
  if (!is_ours || member_.role == TeamRole::kAlone) return;
  const bool is_fixed = member_.config.structure == TeamStructure::kFixedMaster;
  if (is_fixed && member_.config.fixed_leader != from) return;
  // A station without a team of its own is of no branch.
  const bool is_free =
      member_.role == TeamRole::kSelecting ||
      (leads() && !leading_.has_followers() && member_.is_operator(member_.self) &&
       member_.is_sibling(query.mission));
  if (is_free) {
    if (!member_.may_follow(query.mission)) return;
    follow({from,
            from == election_.chosen() ? TeamReason::kSelected : TeamReason::kFollowing});
  }
  if (leads()) return change(leading_.on(member_, from, query));
  if (from != member_.leader.id && member_.is_of_lineage(query.mission))
    presence_.note_encounter(member_.now);
  change(following_.on(member_, from, query));
}

void TeamMember::on(EntityId from, const TeamInform& inform) {
  duplicates_.on(member_, from, inform);
  take(from, inform);
}

void TeamMember::take(EntityId from, const TeamInform& inform) {
  const bool is_ours =
      member_.mission && inform.mission && inform.mission->name == member_.mission->name;
  if (!is_ours) return;
  if (member_.is_operator(member_.self))
    change(TeamStation::on(member_, from, inform, leading_.has_followers()));
  if (member_.follows()) return change(following_.on(member_, from, inform));
  if (leads()) leading_.on(member_, from, inform);
  if (member_.takes_part_in_auction()) member_.take_progress(inform);
}

void TeamMember::on(EntityId from, const TeamHere& here) {
  if (member_.follows()) {
    const TeamTransition followed = TeamFollowing::on(member_, from, here);
    if (!std::holds_alternative<std::monostate>(followed)) return change(followed);
  }
  const auto* contact = member_.contacts.find(from);
  if (contact && !contact->leads && contact->informed == member_.now)
    take(from, contact->inform);
}

void TeamMember::on(EntityId from, const TeamAccept& accept) {
  if (member_.role == TeamRole::kNewcomer) joining_.on(member_, from, accept);
}

void TeamMember::on(EntityId from, const TeamReject& reject) {
  if (member_.role == TeamRole::kNewcomer) joining_.on(member_, from, reject);
}

void TeamMember::on(EntityId from, const TeamAssign& assign) {
  if (member_.role == TeamRole::kSelecting && election_.chosen() == from &&
      member_.is_of_lineage(assign.mission))
    follow({from, TeamReason::kSelected});
  if (following_.on(member_, from, assign)) presence_.say_in_full();
}

void TeamMember::on(EntityId from, const TeamState& state) {
  if (member_.follows()) return TeamFollowing::on(member_, from, state);
  // In an auction nobody has to take newcomers: they take part from when they receive it.
  if (member_.role == TeamRole::kNewcomer &&
      member_.config.structure == TeamStructure::kAuction)
    if (const auto* contact = member_.contacts.find(from);
        contact && contact->inform.mission)
      take_tasks(contact->inform.mission->name, {});
  if (leads()) leading_.on(member_, from, state);
  if (member_.takes_part_in_auction()) TeamAlone::on(member_, from, state);
}

void TeamMember::on(EntityId from, const TeamSplit& split) {
  leading_.on(member_, from, split);  // reports those that were not asked for
}

void TeamMember::on(EntityId, const TeamBids& bids) {
  if (member_.role == TeamRole::kAlone) alone_.on(member_, bids);
}

void TeamMember::on(EntityId from, const TeamProposal& proposal) {
  server_.on(member_, from, proposal);
}

void TeamMember::on(EntityId from, const TeamDecision& decision) {
  if (leads()) leading_.on(member_, from, decision, server_);
}

}  // namespace skein::reasoning
