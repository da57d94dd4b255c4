// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/following.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace skein::reasoning {
namespace {

// What the team knows, to stations that know less and are out of reach of the leader:
// others get it from that.
void inform_stations(MemberState& member) {
  const std::uint32_t number = member.knowledge.number();
  const double silent = kSilentPeriods * member.times().query_period;
  for (const EntityId id : member.config.operators) {
    const auto* station = member.contacts.find(id);
    if (id == member.self || !station ||
        member.now - station->informed > member.follower_lost_after() ||
        !member.is_of_lineage(station->inform.mission) ||
        station->inform.state_number == number)
      continue;
    const bool receives_leader =
        station->inform.master == member.leader.id && station->inform.held <= silent;
    if (!receives_leader)
      member.outbox.send(id, member.knowledge.next_part(member.members));
  }
}

}  // namespace

void TeamFollowing::begin(MemberState& member, EntityId leader, TeamReason reason) {
  if (member.leader.id != leader) member.knowledge.forget_leader();
  member.leader = {leader, member.now, member.now, 0};
  announced_.reset();
  if (const auto* contact = member.contacts.find(leader); contact && contact->leads) {
    member.leader.query = contact->query_number;
    if (member.may_follow(contact->query.mission))
      member.mission = contact->query.mission;
  }
  if (std::ranges::find(member.members, leader) == member.members.end())
    member.members.push_back(leader);
  orders_from_.erase(leader);  // it may count anew since it led here last
  if (order_of_ != leader) order_until_ = member.now + member.exchange_time();
  member.next_inform = member.now;
  member.outbox.report(EventKind::kTeamFollowing,
                       fmt::format("{} leads ({}).", leader.value, name_of(reason)),
                       {.other = leader});
  member.set_status(reason);
}

void TeamFollowing::end(EntityId self) {
  order_until_.reset();
  order_of_ = self;
}

void TeamFollowing::lose_leader(MemberState& member) {
  member.outbox.report(EventKind::kTeamMasterLost,
                       fmt::format("{} is silent for {:.1f} s.", member.leader.id->value,
                                   member.now - member.leader.evidence),
                       {.other = member.leader.id});
  order_until_.reset();
}

void TeamFollowing::drop_old_order(MemberState& member) {
  if (!order_until_ || !member.follows() || member.now <= *order_until_) return;
  order_until_.reset();
  order_of_.reset();
  if (member.own.executing().empty()) return;
  member.outbox.report(EventKind::kTeamOrderExpired,
                       "the new master has given no order; the old one is dropped.");
  member.execute({});
}

// News go to a leader that has just begun to lead here, and knows less.
void TeamFollowing::send_news(MemberState& member) {
  TeamState news = member.knowledge.news();
  if (!news.tasks.empty()) {
    news.members = {member.self};
    member.outbox.send(*member.leader.id, std::move(news));
  }
  inform_stations(member);
}

TeamTransition TeamFollowing::on(MemberState& member, EntityId from,
                                 const TeamQuery& query) {
  TeamLeader& leader = member.leader;
  if (from == leader.id) {
    leader.evidence = leader.received = member.now;
    leader.query = member.contacts.find(from)->query_number;
    member.round_trip = query.round_trip;
    if (member.mission != query.mission) {
      member.mission = query.mission;
      member.set_status(TeamReason::kSplit);
    }
    announced_ = query.successor;
    if (announced_ == member.self) return LeadTeam{TeamReason::kHandover, from};
    return {};
  }
  if (!member.is_of_lineage(query.mission)) return {};
  if (announced_ == from) return FollowOther{from, TeamReason::kHandover};
  // Others have lost the leader a little earlier. Who has led for long took over in
  // another part of the team.
  const bool silent =
      member.now - leader.evidence > kSilentPeriods * member.times().query_period;
  const bool just_now = query.led < member.lost + member.round_trip;
  if (query.predecessor == leader.id && silent && just_now)
    return FollowOther{from, TeamReason::kSelected};
  return {};
}

TeamTransition TeamFollowing::on(MemberState& member, EntityId from,
                                 const TeamInform& inform) {
  if (!member.is_of_lineage(inform.mission)) return {};
  TeamLeader& leader = member.leader;
  if (from == leader.id) {
    if (!inform.master || *inform.master == from) return {};
    if (*inform.master != member.self)
      return FollowOther{*inform.master,
                         inform.leaving ? TeamReason::kHandover : TeamReason::kMerged};
    // Each follows the other: somebody must lead.
    if (member.self < from || inform.leaving) return LeadTeam{TeamReason::kMerged, from};
    return {};
  }
  // Others have received the leader meanwhile: it is there, only its messages to here are
  // lost. Not for ever: who does not receive it gets no orders.
  if (inform.master != leader.id || inform.query <= leader.query ||
      (member.now - leader.received > 3 * member.lost &&
       !member.is_operator(member.self)))
    return {};
  leader.query = inform.query;
  leader.evidence = std::max(leader.evidence, member.now - inform.held);
  return {};
}

// The leader follows somebody else, and all that said so in full was lost.
TeamTransition TeamFollowing::on(const MemberState& member, EntityId from,
                                 const TeamHere& here) {
  const auto* contact = member.contacts.find(from);
  if (from != member.leader.id || !contact || !contact->leads || !here.master ||
      *here.master == from || *here.master == member.self)
    return {};
  return FollowOther{*here.master, TeamReason::kMerged};
}

void TeamFollowing::on(MemberState& member, EntityId from, const TeamState& state) {
  const auto* contact = member.contacts.find(from);
  if (!contact) return;
  // Others of its team pass on to a station what the leader says.
  if (member.is_operator(member.self) && from != member.leader.id &&
      member.is_of_lineage(contact->inform.mission))
    member.knowledge.add(state, std::nullopt);
  if (from != member.leader.id || !contact->leads) return;
  if (state.number == contact->query.state_number) member.knowledge.take(state);
  if (hash_of_members(state.members) != contact->query.members_hash) return;
  member.members = state.members;
  member.set_status(TeamReason::kMembers);
}

bool TeamFollowing::on(MemberState& member, EntityId from, const TeamAssign& assign) {
  if (!member.follows() || member.leader.id != from ||
      !member.is_of_lineage(assign.mission)) {
    // Common after a change of leader; of anybody else it is forged.
    member.outbox.report(EventKind::kTeamOrderRefused,
                         fmt::format("{} does not lead here.", from.value),
                         {.other = from});
    return false;
  }
  std::uint32_t& last = orders_from_[from];
  if (assign.number < last) return false;  // an older one that was repeated
  last = assign.number;
  order_of_ = from;
  order_until_.reset();
  // What is done is not flown again, though the leader does not know yet.
  std::vector<std::uint32_t> tasks;
  for (const TeamTask& task : assign.tasks) {
    const auto& known =
        member.knowledge.tasks.try_emplace(task.number, task).first->second;
    if (!known.done && !member.own.has_done(task.number) &&
        !member.own.has_yielded(task.number))
      tasks.push_back(task.number);
  }
  const bool leaves_out = tasks.size() < assign.tasks.size();
  if (leaves_out) member.next_inform = member.now;
  member.knowledge.compare(assign.tasks);
  member.execute(std::move(tasks));
  member.outbox.send(from, TeamAssignAck{assign.number});
  return leaves_out;
}

}  // namespace skein::reasoning
