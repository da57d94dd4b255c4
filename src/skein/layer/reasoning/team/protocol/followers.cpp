// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/followers.h"

#include <fmt/format.h>

#include <algorithm>

namespace skein::reasoning {

void TeamFollowers::begin(MemberState& member) {
  clear();
  member.members = {member.self};
  std::vector<std::uint32_t> open = member.own.executing();
  std::erase_if(open, [&](std::uint32_t task) {
    return !member.knowledge.tasks.contains(task) || member.knowledge.is_over(task);
  });
  orders_.set(member.self, std::move(open));
}

void TeamFollowers::clear() {
  followers_.clear();
  orders_.clear();
}

void TeamFollowers::add(MemberState& member, EntityId id, bool certain, const char* why) {
  const auto [place, is_new] = followers_.try_emplace(id);
  place->second.certain = place->second.certain || certain;
  place->second.claimed = member.now;
  if (!is_new) return;
  auto& members = member.members;
  if (const auto at = std::ranges::lower_bound(members, id);
      at == members.end() || *at != id)
    members.insert(at, id);
  member.outbox.report(EventKind::kTeamJoined,
                       fmt::format("{} follows ({}).", id.value, why), {.other = id});
  if (const auto* contact = member.contacts.find(id)) {
    orders_.set(id, {});
    orders_.informed(id, worker_of(id, contact->inform).tasks);
  }
  member.allocation_due = true;
}

void TeamFollowers::drop(MemberState& member, EntityId id, const std::string& why) {
  followers_.erase(id);
  std::erase(member.members, id);
  orders_.remove(id);
  round_trips_.forget(id);
  member.outbox.report(EventKind::kTeamFollowerLost, fmt::format("{} {}.", id.value, why),
                       {.other = id});
  member.allocation_due = true;
}

void TeamFollowers::drop_silent(MemberState& member) {
  std::vector<EntityId> silent;
  const double holds = member.follower_lost_after();
  for (const auto& [id, follower] : followers_) {
    const double patience = follower.certain ? holds : member.exchange_time();
    if (member.now - follower.claimed > patience) silent.push_back(id);
  }
  for (const EntityId id : silent) drop(member, id, "is silent");
  // Its answers are a second way to hear of it.
  const double period = follower_period(member.times(), member.status.members.size());
  const double overdue = std::max(member.lost / 2, period + member.times().query_period);
  for (const auto& [id, follower] : followers_)
    if (member.now - follower.claimed > overdue) orders_.remind(id);
}

void TeamFollowers::confirmed(MemberState& member, EntityId from,
                              const TeamInform& inform) {
  if (const auto longest =
          round_trips_.answered(from, inform.query, inform.held, member.now))
    member.round_trip = *longest;
  add(member, from, true, "it says so");
  Follower& follower = followers_.at(from);
  if (follower.able != inform.resources.able ||
      follower.refused != inform.resources.refused)
    member.allocation_due = true;
  follower.able = inform.resources.able;
  follower.refused = inform.resources.refused;
  orders_.informed(from, worker_of(from, inform).tasks);
  member.take_progress(inform);
}

void TeamFollowers::follows_other(MemberState& member, EntityId from, EntityId leader,
                                  bool hands_on) {
  const auto known = followers_.find(from);
  if (known != followers_.end() && known->second.certain && !hands_on)
    drop(member, from, fmt::format("follows {}", leader.value));
}

void TeamFollowers::declined(MemberState& member, EntityId from) {
  const auto follower = followers_.find(from);
  if (follower != followers_.end() && !follower->second.certain)
    drop(member, from, "has joined another team");
}

void TeamFollowers::on(MemberState& member, EntityId from, const TeamAssignAck& ack) {
  if (!orders_.acknowledge(from, ack.number))
    return member.outbox.report(
        EventKind::kTeamAnswerRefused,
        fmt::format("{} answers an order that there was not.", from.value),
        {.other = from});
  const auto follower = followers_.find(from);
  if (follower != followers_.end()) follower->second.claimed = member.now;
}

std::vector<EntityId> TeamFollowers::candidates(const MemberState& member,
                                                std::optional<EntityId> except) const {
  std::vector<EntityId> all;
  for (const auto& [id, follower] : followers_) {
    const auto* contact = member.contacts.find(id);
    if (follower.certain && contact && !contact->inform.leaving && id != except &&
        contact->inform.state_number == member.knowledge.number())
      all.push_back(id);
  }
  return all;
}

bool TeamFollowers::lag_behind(const MemberState& member, const TeamQuery& query) const {
  return std::ranges::any_of(followers_, [&](const auto& follower) {
    const auto* contact = member.contacts.find(follower.first);
    return !contact || contact->inform.members_hash != query.members_hash ||
           contact->inform.state_number != query.state_number;
  });
}

std::vector<TeamWorker> TeamFollowers::workers(const MemberState& member) const {
  std::vector<TeamWorker> all;
  for (const EntityId id : member.members) {
    if (id == member.self) {
      if (member.own.resources().able) all.push_back(member.own_worker());
      continue;
    }
    const auto* contact = member.contacts.find(id);
    if (contact && contact->inform.resources.able)
      all.push_back(worker_of(id, contact->inform));
  }
  return all;
}

void TeamFollowers::set_orders(const MemberState& member, const TeamAllocation& given,
                               std::span<const TeamTask> tasks) {
  for (const EntityId id : member.members) {
    const auto own = given.find(id);
    orders_.set(id, own == given.end() ? std::vector<std::uint32_t>{}
                                       : orderable(own->second, tasks));
  }
}

void TeamFollowers::give_orders(MemberState& member) {
  const auto outcome = orders_.step(member.now, member.repeat_after(),
                                    member.times().query_period, member.exchange_time());
  for (const TeamOrders::Sent& order : outcome.sent) {
    TeamAssign assign{*member.mission, order.number, {}};
    for (const std::uint32_t task : order.tasks)
      assign.tasks.push_back(member.knowledge.tasks.at(task));
    member.outbox.send(order.to, std::move(assign));
  }
  for (const EntityId id : outcome.unanswered)
    member.outbox.report(EventKind::kTeamOrderUnanswered,
                         fmt::format("{} has not acknowledged its order.", id.value),
                         {.other = id});
  std::vector<std::uint32_t> own = orders_.own();
  std::erase_if(own, [&](std::uint32_t task) { return member.own.has_yielded(task); });
  member.execute(std::move(own));
}

}  // namespace skein::reasoning
