// SPDX-License-Identifier: Apache-2.0
// How a newcomer finds a team, and how a master takes it in.
#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "skein/layer/reasoning/team/protocol/team_member.h"

namespace skein::reasoning {
namespace {

constexpr double kListen = 2;  // query periods from the first master heard on
constexpr double kRest = 10;   // query periods after all have rejected it
constexpr int kConfirmRepeats = 3;

}  // namespace

void TeamMember::step_joining() {
  if (now_ < joining_.rest_until) return;
  std::vector<EntityId> masters;
  for (const auto& [id, contact] : contacts_.all()) {
    const bool may =
        config_.structure != TeamStructure::kFixedMaster || config_.fixed_master == id;
    if (contact.leads && now_ - contact.queried <= lost_ && may) {
      masters.push_back(id);
      round_trip_ = std::max<double>(round_trip_, contact.query.round_trip);
    }
  }
  if (masters.empty() && joining_.proposed < 0) {
    joining_.first_master = -1;
    return;
  }
  if (joining_.first_master < 0) joining_.first_master = now_;
  const double period = times().query_period;
  if (now_ - joining_.first_master < kListen * period) return;
  if (joining_.proposed < 0) {
    joining_.proposed = joining_.next = now_;
    joining_.asked.clear();
    joining_.rejected.clear();
    ++exchange_;
    for (const EntityId id : masters) joining_.asked[id] = std::nullopt;
  }
  if (now_ >= joining_.next) {
    for (const auto& [id, answer] : joining_.asked)
      if (!answer && !joining_.rejected.contains(id))
        send_one(id, TeamPropose{exchange_, resources_});
    joining_.next = now_ + repeat_after();
  }
  choose_team();
}

void TeamMember::choose_team() {
  using Rank = std::tuple<double, std::uint32_t, EntityId>;
  std::optional<Rank> best;
  std::size_t open = 0;
  for (const auto& [id, answer] : joining_.asked) {
    if (!answer) {
      open += joining_.rejected.contains(id) ? 0 : 1;
      continue;
    }
    const Rank rank{answer->distance, answer->members, id};
    if (!best || rank < *best) best = rank;
  }
  const double waited = now_ - joining_.proposed;
  const bool all_answered = open == 0;
  const bool over = waited > exchange_time();
  if (!all_answered && !over) return;
  joining_.proposed = joining_.first_master = -1;
  if (!best) {
    if (!joining_.rejected.empty()) {
      report(EventKind::kTeamRejected, "no master has use for it.");
      joining_.rest_until = now_ + kRest * times().query_period;
    }
    return;
  }
  const EntityId chosen = std::get<EntityId>(*best);
  for (const auto& [id, answer] : joining_.asked)
    if (answer && id != chosen) send_one(id, TeamDecline{exchange_});
  mission_ = joining_.asked.at(chosen)->mission;
  repeat(chosen, TeamConfirm{exchange_}, kConfirmRepeats);
  follow(chosen, TeamReason::kJoined);
}

void TeamMember::on(EntityId from, const TeamPropose& propose) {
  if (role_ != Role::kLeading) return;
  const auto tasks = open_tasks();
  if (config_.admit && !config_.admit(propose.resources, tasks, workers()))
    return send_one(from, TeamReject{propose.exchange});
  double nearest = 0;
  for (const TeamTask& task : tasks) {
    const double distance =
        (task.place - geo::horizontal(propose.resources.place)).norm();
    nearest = &task == &tasks.front() ? distance : std::min(nearest, distance);
  }
  accepted_[from] = propose.exchange;
  send_one(from, TeamAccept{propose.exchange, *mission_, nearest,
                            static_cast<std::uint32_t>(followers_.size() + 1)});
}

void TeamMember::on(EntityId from, const TeamAccept& accept) {
  if (role_ != Role::kNewcomer || accept.exchange != exchange_) return;
  const auto asked = joining_.asked.find(from);
  if (asked == joining_.asked.end())
    return report(EventKind::kTeamAnswerRefused,
                  fmt::format("{} was not asked.", from.value), {.other = from});
  asked->second = accept;
}

void TeamMember::on(EntityId from, const TeamReject& reject) {
  if (role_ != Role::kNewcomer || reject.exchange != exchange_) return;
  if (!joining_.asked.contains(from))
    return report(EventKind::kTeamAnswerRefused,
                  fmt::format("{} was not asked.", from.value), {.other = from});
  joining_.rejected.insert(from);
}

void TeamMember::on(EntityId from, const TeamConfirm& confirm) {
  if (role_ != Role::kLeading) return;
  const auto accepted = accepted_.find(from);
  if (accepted == accepted_.end() || accepted->second != confirm.exchange)
    return report(EventKind::kTeamAnswerRefused,
                  fmt::format("{} was not accepted.", from.value), {.other = from});
  add_follower(from, false, "it has joined");
}

void TeamMember::on(EntityId from, const TeamDecline& decline) {
  (void)decline;
  const auto follower = followers_.find(from);
  if (role_ == Role::kLeading && follower != followers_.end() &&
      !follower->second.certain)
    drop_follower(from, "has joined another team");
}

}  // namespace skein::reasoning
