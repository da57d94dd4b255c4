// SPDX-License-Identifier: Apache-2.0
// What masters of the same mission do when they meet.
#include <fmt/format.h>

#include <algorithm>

#include "skein/layer/reasoning/team/protocol/team_member.h"

namespace skein::reasoning {
namespace {

constexpr int kMergeRepeats = 3;
constexpr std::size_t kTasksInSplit = 8;

TeamMeeting meeting_of(EntityId a, EntityId b, std::uint32_t times) {
  return {std::min(a, b), std::max(a, b), times};
}

}  // namespace

// The higher id of the two gives way, or asks for a split: only it decides, so that both
// agree on how often they met. Who has led for less than it takes to be heard of is no
// master of another team, but has begun to lead in one that has a master: it gives way,
// and that does not count as meeting.
void TeamMember::meet(EntityId other, const TeamQuery& query) {
  if (config_.structure == TeamStructure::kFixedMaster) return;
  if (asked_ && asked_->of == other) return;
  const double fresh = exchange_time();
  const bool self_fresh = now_ - led_since_ < fresh;
  const bool other_fresh = query.led < fresh;
  // A station has led until it hears of somebody else.
  if (is_operator(other) && !is_operator(self_)) return;
  if (is_operator(self_) && !is_operator(other)) return yield_to(other, false);
  const bool gives_way = self_fresh == other_fresh ? other < self_ : self_fresh;
  if (!gives_way && mission_->branch == self_ && split_with_.contains(other)) {
    // It does not know yet.
    siblings_[other] = now_;
    return send_split(other, {mission_->name, other});
  }
  if (!gives_way) {
    const auto [rival, is_new] = rivals_.try_emplace(other, Rival{now_, now_});
    rival->second.heard = now_;
    return;
  }
  const bool counts = !self_fresh && !other_fresh;
  if (counts && knowledge_.meetings(self_, other) >= 1)
    ask_split(other);
  else
    yield_to(other, counts);
}

// Both stop assigning, until the other has given way or does not seem to hear.
bool TeamMember::is_held_by_rival() {
  std::erase_if(rivals_, [&](const auto& r) { return now_ - r.second.heard > lost_; });
  return std::ranges::any_of(
      rivals_, [&](const auto& r) { return now_ - r.second.first <= exchange_time(); });
}

void TeamMember::yield_to(EntityId other, bool counted) {
  const std::uint32_t times = knowledge_.meetings(self_, other) + (counted ? 1 : 0);
  const TeamMeeting meeting = meeting_of(self_, other, times);
  knowledge_.note(meeting);
  const auto members = member_ids();
  report(EventKind::kTeamMerged, fmt::format("with the team of {}.", other.value),
         {.other = other});
  send_knowledge();
  repeat(other, TeamMerge{*mission_, meeting, false, members}, kMergeRepeats);
  follow(other, TeamReason::kMerged);
}

void TeamMember::ask_split(EntityId other) {
  if (!asked_) {
    asked_ = Asked{other, now_, now_, {}};
    send_knowledge();
  }
  asked_->last = now_;
  const auto meetings = knowledge_.meetings(self_, other) + 1;
  send_one(other,
           TeamMerge{*mission_, meeting_of(self_, other, meetings), true, member_ids()});
}

void TeamMember::on(EntityId from, const TeamMerge& merge) {
  if (role_ != Role::kLeading || !is_of_lineage(merge.mission)) {
    if (merge.split && role_ == Role::kLeading && is_sibling(merge.mission)) return;
    if (role_ == Role::kLeading)
      report(EventKind::kTeamAnswerRefused,
             fmt::format("{} is of another mission.", from.value), {.other = from});
    return;
  }
  const auto* sender = contacts_.find(from);
  // Who gives way may have said already that it follows.
  const bool led =
      sender && (sender->leads || (!merge.split && sender->inform.master == self_));
  if (!led)
    return report(EventKind::kTeamAnswerRefused,
                  fmt::format("{} led no team.", from.value), {.other = from});
  if (merge.split) return answer_split(from, merge);
  knowledge_.note(merge.meeting);
  rivals_.erase(from);
  // Their tasks are part of this one's, when either was a branch.
  if (!mission_->branch && merge.mission.branch) mission_ = merge.mission;
  bool is_new = false;
  std::vector<EntityId> all = merge.members;
  all.push_back(from);
  for (const EntityId id : all) {
    const auto* contact = contacts_.find(id);
    if (id == self_ || followers_.contains(id) || !contact ||
        now_ - contact->heard > follower_lost_after())
      continue;
    add_follower(id, false, "merged");
    is_new = true;
  }
  if (!is_new) return;
  report(EventKind::kTeamMerged, fmt::format("with the team of {}.", from.value),
         {.other = from});
  set_status(TeamReason::kMerged);
}

void TeamMember::answer_split(EntityId other, const TeamMerge& merge) {
  const TeamMission theirs{mission_->name, other};
  const bool is_done = mission_->branch == self_ &&
                       std::ranges::any_of(knowledge_.tasks, [&](const auto& task) {
                         return task.second.branch == other;
                       });
  if (is_done || (mission_->branch == self_ && split_with_.contains(other)))
    return send_split(other, theirs);
  std::vector<TeamWorker> second;
  for (const EntityId id : merge.members) {
    const auto* contact = contacts_.find(id);
    if (id == other) continue;
    TeamWorker& worker = second.emplace_back();
    worker.id = id;
    if (!contact || now_ - contact->informed > follower_lost_after()) continue;
    worker.resources = contact->inform.resources;
    for (const TeamProgress& task : contact->inform.tasks)
      worker.tasks.push_back(task.task);
  }
  // The other one itself informs nobody while it leads.
  second.push_back({other, {}, {}});
  const auto tasks = open_tasks();
  const auto ours = config_.divide(tasks, workers(), second);
  for (const TeamTask& task : tasks)
    knowledge_.tasks.at(task.number).branch = ours.contains(task.number) ? self_ : other;
  mission_ = TeamMission{mission_->name, self_};
  knowledge_.note(merge.meeting);
  rivals_.erase(other);
  split_with_.insert(other);
  siblings_[other] = now_ + round_trip_;  // until it knows
  siblings_[self_] = now_;
  changed_ = true;
  next_query_ = now_;
  report(EventKind::kTeamSplit,
         fmt::format("with {}: this is {}.", other.value, name_of(*mission_)),
         {.other = other});
  set_status(TeamReason::kSplit);
  send_split(other, theirs);
}

void TeamMember::send_split(EntityId other, const TeamMission& mission) {
  std::vector<TeamTask> all;
  for (const auto& [number, task] : knowledge_.tasks) all.push_back(task);
  const std::size_t parts =
      std::max<std::size_t>(1, (all.size() + kTasksInSplit - 1) / kTasksInSplit);
  for (std::size_t part = 0; part < parts; ++part) {
    TeamSplit split{mission,
                    meeting_of(self_, other, knowledge_.meetings(self_, other)),
                    static_cast<std::uint32_t>(part),
                    static_cast<std::uint32_t>(parts),
                    {}};
    for (std::size_t at = part * kTasksInSplit;
         at < std::min(all.size(), (part + 1) * kTasksInSplit); ++at)
      split.tasks.push_back(all[at]);
    send_one(other, std::move(split));
  }
}

void TeamMember::on(EntityId from, const TeamSplit& split) {
  const bool waits = role_ == Role::kLeading && asked_ && asked_->of == from &&
                     mission_->name == split.mission.name &&
                     split.mission.branch == self_;
  if (!waits) {
    // The last answers to a question that was repeated.
    if (role_ == Role::kLeading && mission_ && *mission_ == split.mission) return;
    return report(EventKind::kTeamAnswerRefused,
                  fmt::format("{} was not asked for a split.", from.value),
                  {.other = from});
  }
  asked_->parts[split.part] = split.tasks;
  if (asked_->parts.size() < split.parts) return;
  std::vector<TeamTask> all;
  for (const auto& [part, tasks] : asked_->parts)
    all.insert(all.end(), tasks.begin(), tasks.end());
  knowledge_.divide(all);
  // What the other one does not know stays here.
  for (auto& [number, task] : knowledge_.tasks)
    if (!task.done && !task.branch) task.branch = self_;
  asked_.reset();
  mission_ = split.mission;
  knowledge_.note(split.meeting);
  rivals_.erase(from);
  std::erase_if(repeated_, [&](const Repeated& one) { return one.to == from; });
  for (const auto& [number, task] : knowledge_.tasks)
    if (task.branch) siblings_[*task.branch] = now_;
  changed_ = true;
  next_query_ = now_;
  report(EventKind::kTeamSplit,
         fmt::format("with {}: this is {}.", from.value, name_of(*mission_)),
         {.other = from});
  set_status(TeamReason::kSplit);
}

}  // namespace skein::reasoning
