// SPDX-License-Identifier: Apache-2.0
// What goes on between a team and the stations of its operators.
#include <algorithm>

#include "skein/layer/reasoning/team/protocol/team_member.h"

namespace skein::reasoning {

void TeamMember::hand_in(const std::string& mission, std::span<const TeamTask> tasks,
                         Time now) {
  for (const TeamTask& task : tasks) handed_in_[task.number] = task;
  submit(mission, tasks, now);
}

bool TeamMember::withdraw_task(std::uint32_t task) {
  const auto own = handed_in_.find(task);
  const bool is_unheard = own != handed_in_.end() && !knowledge_.tasks.contains(task);
  if (is_unheard ? own->second.done : !knowledge_.withdraw(task)) return false;
  if (own != handed_in_.end()) own->second.done = own->second.withdrawn = true;
  if (is_unheard) withdrawn_.insert(task);
  changed_ = true;
  return true;
}

// What was withdrawn while it was on its way, once it has arrived.
void TeamMember::withdraw_handed_in() {
  std::erase_if(withdrawn_, [this](std::uint32_t task) {
    if (!knowledge_.tasks.contains(task)) return false;
    if (knowledge_.withdraw(task)) changed_ = true;
    return true;
  });
}

std::map<std::uint32_t, TeamTask> TeamMember::all_tasks() const {
  std::map<std::uint32_t, TeamTask> all = knowledge_.tasks;
  all.insert(handed_in_.begin(), handed_in_.end());
  return all;
}

std::map<std::uint32_t, EntityId> TeamMember::executors() const {
  constexpr double kForgotten = 3;  // T_lost: a station may be out of reach for a while
  std::map<std::uint32_t, EntityId> all;
  for (const auto& [id, contact] : contacts_.all()) {
    if (now_ - contact.informed > kForgotten * lost_) continue;
    const auto& tasks = contact.inform.tasks;
    if (tasks.empty()) continue;
    const auto left = std::ranges::find_if(
        tasks, [](const TeamProgress& task) { return task.share < 1; });
    const auto flown = left == tasks.end() ? tasks.front().task : left->task;
    const auto [known, is_first] = all.try_emplace(flown, id);
    if (!is_first && contact.informed > contacts_.find(known->second)->informed)
      known->second = id;
  }
  return all;
}

// Those that the master does not know.
void TeamMember::send_handed_in() {
  constexpr std::size_t kMaxAtOnce = 8;
  TeamState state;
  for (const auto& [number, task] : handed_in_)
    if (!knowledge_.tasks.contains(number) && state.tasks.size() < kMaxAtOnce)
      state.tasks.push_back(task);
  if (state.tasks.empty()) return;
  state.members = {self_};
  send_one(*master_, std::move(state));
}

// What the team knows, to stations that know less and are out of reach of the master:
// others get it from that.
void TeamMember::inform_stations() {
  const std::uint32_t number = knowledge_.number();
  for (const EntityId id : config_.operators) {
    const auto* station = contacts_.find(id);
    if (id == self_ || !station || now_ - station->informed > follower_lost_after() ||
        !is_of_lineage(station->inform.mission) || station->inform.state_number == number)
      continue;
    const bool receives_master = station->inform.master == master_ &&
                                 station->inform.held <= kSilent * times().query_period;
    if (!receives_master) send_one(id, knowledge_.part(next_part_++, members_));
  }
}

// A station leads again when it has heard none of its team for long: others lead on where
// it does not hear them.
bool TeamMember::is_team_gone() const {
  return now_ - evidence_ > lost_ + exchange_time() &&
         std::ranges::none_of(contacts_.all(), [&](const auto& contact) {
           return now_ - contact.second.informed <= follower_lost_after() &&
                  may_follow(contact.second.inform.mission);
         });
}

// A station needs no orders: what others say of their master is enough to follow it, and
// to lead no more.
void TeamMember::inform_as_station(EntityId from, const TeamInform& inform) {
  if (role_ != Role::kSelecting && role_ != Role::kLeading) return;
  const bool leads_some = role_ == Role::kLeading && !followers_.empty();
  if (!(leads_some ? is_of_lineage(inform.mission) : may_follow(inform.mission))) return;
  const bool hears = inform.held <= 2 * times().query_period;
  if (!inform.master || *inform.master == self_ || *inform.master == from || !hears)
    return;
  mission_ = inform.mission;
  follow(*inform.master, TeamReason::kFollowing);
}

}  // namespace skein::reasoning
