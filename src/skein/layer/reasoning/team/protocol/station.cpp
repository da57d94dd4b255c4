// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/station.h"

#include <algorithm>
#include <cstddef>

namespace skein::reasoning {
namespace {

constexpr std::size_t kMaxTasksAtOnce = 8;  // in a message

}  // namespace

void TeamStation::hand_in(std::span<const TeamTask> tasks) {
  for (const TeamTask& task : tasks) handed_in_[task.number] = task;
}

bool TeamStation::withdraw(MemberState& member, std::uint32_t task) {
  const auto own = handed_in_.find(task);
  const bool is_on_its_way =
      own != handed_in_.end() && !member.knowledge.tasks.contains(task);
  if (is_on_its_way ? own->second.done : !member.knowledge.withdraw(task)) return false;
  if (own != handed_in_.end()) own->second.done = own->second.withdrawn = true;
  if (is_on_its_way) withdrawn_.insert(task);
  member.allocation_due = true;
  return true;
}

void TeamStation::step(MemberState& member) {
  std::erase_if(withdrawn_, [&member](std::uint32_t task) {
    if (!member.knowledge.tasks.contains(task)) return false;
    member.allocation_due |= member.knowledge.withdraw(task);
    return true;
  });
}

void TeamStation::send_handed_in(MemberState& member) const {
  TeamState state;
  for (const auto& [number, task] : handed_in_)
    if (!member.knowledge.tasks.contains(number) && state.tasks.size() < kMaxTasksAtOnce)
      state.tasks.push_back(task);
  if (state.tasks.empty()) return;
  state.members = {member.self};
  member.outbox.send(*member.leader.id, std::move(state));
}

void TeamStation::add_handed_in(MemberState& member) const {
  for (const auto& [number, task] : handed_in_) {
    const auto [place, is_new] = member.knowledge.tasks.try_emplace(number, task);
    if (is_new) place->second.branch = member.mission->branch;
  }
}

std::map<std::uint32_t, TeamTask> TeamStation::all_tasks(
    const TeamKnowledge& knowledge) const {
  std::map<std::uint32_t, TeamTask> all = knowledge.tasks;
  all.insert(handed_in_.begin(), handed_in_.end());
  return all;
}

bool TeamStation::is_team_gone(const MemberState& member) {
  return member.now - member.leader.evidence > member.lost + member.exchange_time() &&
         std::ranges::none_of(member.contacts.all(), [&](const auto& contact) {
           return member.now - contact.second.informed <= member.follower_lost_after() &&
                  member.may_follow(contact.second.inform.mission);
         });
}

TeamTransition TeamStation::on(MemberState& member, EntityId from,
                               const TeamInform& inform, bool has_followers) {
  if (member.role != TeamRole::kSelecting && !member.leads()) return {};
  const bool may = member.leads() && has_followers ? member.is_of_lineage(inform.mission)
                                                   : member.may_follow(inform.mission);
  const bool receives_leader =
      inform.held <= kSilentPeriods * member.times().query_period;
  if (!may || !receives_leader || !inform.master || *inform.master == member.self ||
      *inform.master == from)
    return {};
  member.mission = inform.mission;
  return FollowOther{*inform.master, TeamReason::kFollowing};
}

}  // namespace skein::reasoning
