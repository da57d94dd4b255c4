// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/joining.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace skein::reasoning {
namespace {

constexpr double kListenPeriods = 2;  // query periods from the first leader received on
constexpr double kRestPeriods = 10;   // query periods after all have rejected it
constexpr int kConfirms = 4;

}  // namespace

std::vector<EntityId> TeamJoining::leaders(MemberState& member) const {
  std::vector<EntityId> all;
  for (const auto& [id, contact] : member.contacts.all()) {
    const bool may = member.config.structure != TeamStructure::kFixedMaster ||
                     member.config.fixed_leader == id;
    if (!contact.leads || member.now - contact.queried > member.lost || !may) continue;
    all.push_back(id);
    member.round_trip = std::max<double>(member.round_trip, contact.query.round_trip);
  }
  return all;
}

TeamTransition TeamJoining::step(MemberState& member) {
  const double now = member.now;
  if (now < rest_until_) return {};
  const auto received = leaders(member);
  if (received.empty() && proposed_ < 0) {
    first_leader_ = -1;
    return {};
  }
  if (first_leader_ < 0) first_leader_ = now;
  if (now - first_leader_ < kListenPeriods * member.times().query_period) return {};
  if (proposed_ < 0) {
    proposed_ = next_ = now;
    asked_.clear();
    rejected_.clear();
    ++exchange_;
    for (const EntityId id : received) asked_[id] = std::nullopt;
  }
  if (now >= next_) {
    for (const auto& [id, answer] : asked_)
      if (!answer && !rejected_.contains(id))
        member.outbox.send(id, TeamPropose{exchange_, member.own.resources()});
    next_ = now + member.repeat_after();
  }
  return choose(member);
}

TeamTransition TeamJoining::choose(MemberState& member) {
  using Rank = std::tuple<double, std::uint32_t, EntityId>;
  std::optional<Rank> best;
  std::size_t open = 0;
  for (const auto& [id, answer] : asked_) {
    if (!answer) {
      open += rejected_.contains(id) ? 0 : 1;
      continue;
    }
    const Rank rank{answer->distance, answer->members, id};
    if (!best || rank < *best) best = rank;
  }
  const bool is_over = member.now - proposed_ > member.exchange_time();
  if (open > 0 && !is_over) return {};
  proposed_ = first_leader_ = -1;
  if (!best) {
    if (!rejected_.empty()) {
      member.outbox.report(EventKind::kTeamRejected, "no master has use for it.");
      rest_until_ = member.now + kRestPeriods * member.times().query_period;
    }
    return {};
  }
  const EntityId chosen = std::get<EntityId>(*best);
  for (const auto& [id, answer] : asked_)
    if (answer && id != chosen) member.outbox.send(id, TeamDecline{exchange_});
  member.mission = asked_.at(chosen)->mission;
  member.outbox.repeat(chosen, TeamConfirm{exchange_}, kConfirms,
                       member.now + member.exchange_time());
  return FollowOther{chosen, TeamReason::kJoined};
}

void TeamJoining::on(MemberState& member, EntityId from, const TeamAccept& accept) {
  if (accept.exchange != exchange_) return;
  const auto asked = asked_.find(from);
  if (asked == asked_.end())
    return member.outbox.report(EventKind::kTeamAnswerRefused,
                                fmt::format("{} was not asked.", from.value),
                                {.other = from});
  asked->second = accept;
}

void TeamJoining::on(MemberState& member, EntityId from, const TeamReject& reject) {
  if (reject.exchange != exchange_) return;
  if (!asked_.contains(from))
    return member.outbox.report(EventKind::kTeamAnswerRefused,
                                fmt::format("{} was not asked.", from.value),
                                {.other = from});
  rejected_.insert(from);
}

}  // namespace skein::reasoning
