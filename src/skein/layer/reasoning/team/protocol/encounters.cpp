// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/encounters.h"

#include <fmt/format.h>

#include <algorithm>

#include "skein/layer/reasoning/team/protocol/branches.h"

namespace skein::reasoning {
namespace {

constexpr int kMerges = 4;  // times that it is said
constexpr std::size_t kTasksInSplit = 8;

TeamEncounter encounter_of(EntityId a, EntityId b, std::uint32_t times) {
  return {std::min(a, b), std::max(a, b), times};
}

void send_split(MemberState& member, EntityId other, const TeamMission& mission) {
  std::vector<TeamTask> all;
  for (const auto& [number, task] : member.knowledge.tasks) all.push_back(task);
  const TeamEncounter encounter =
      encounter_of(member.self, other, member.knowledge.encounters(member.self, other));
  const std::size_t parts =
      std::max<std::size_t>(1, (all.size() + kTasksInSplit - 1) / kTasksInSplit);
  for (std::size_t part = 0; part < parts; ++part) {
    TeamSplit split{mission,
                    encounter,
                    static_cast<std::uint32_t>(part),
                    static_cast<std::uint32_t>(parts),
                    {}};
    for (std::size_t at = part * kTasksInSplit;
         at < std::min(all.size(), (part + 1) * kTasksInSplit); ++at)
      split.tasks.push_back(all[at]);
    member.outbox.send(other, std::move(split));
  }
}

// The mission is split: this one's part is another one than before.
void begin_branch(MemberState& member, EntityId other, const TeamMission& mission,
                  const TeamEncounter& encounter) {
  member.mission = mission;
  member.knowledge.note(encounter);
  member.allocation_due = true;
  member.next_query = member.now;
  member.outbox.report(EventKind::kTeamSplit,
                       fmt::format("with {}: this is {}.", other.value, name_of(mission)),
                       {.other = other});
  member.set_status(TeamReason::kSplit);
}

std::vector<TeamWorker> workers_of(const MemberState& member, EntityId leader,
                                   std::span<const EntityId> ids) {
  std::vector<TeamWorker> all;
  for (const EntityId id : ids) {
    if (id == leader) continue;
    TeamWorker& worker = all.emplace_back();
    worker.id = id;
    const auto* contact = member.contacts.find(id);
    if (!contact || member.now - contact->informed > member.follower_lost_after())
      continue;
    worker.resources = contact->inform.resources;
    for (const TeamProgress& task : contact->inform.tasks)
      worker.tasks.push_back(task.task);
  }
  // The leader itself informs nobody while it leads.
  all.push_back({leader, {}, {}});
  return all;
}

}  // namespace

void send_knowledge(MemberState& member) {
  for (std::uint32_t part = 0; part < member.knowledge.parts(); ++part)
    member.outbox.send_all(member.knowledge.part(part, member.members));
}

void TeamEncounters::clear() {
  rivals_.clear();
  asked_.reset();
}

TeamTransition TeamEncounters::meet(MemberState& member, EntityId other,
                                    const TeamQuery& query, double led_since,
                                    TeamBranches& branches) {
  const EntityId self = member.self;
  if (member.config.structure == TeamStructure::kFixedMaster) return {};
  if (asked_ && asked_->of == other) return {};
  const double fresh = member.exchange_time();
  const bool self_fresh = member.now - led_since < fresh;
  const bool other_fresh = query.led < fresh;
  // A station has led until it hears of somebody else.
  if (member.is_operator(other) && !member.is_operator(self)) return {};
  if (member.is_operator(self) && !member.is_operator(other))
    return yield_to(member, other, false);
  const bool gives_way = self_fresh == other_fresh ? other < self : self_fresh;
  if (!gives_way && member.mission->branch == self && split_with_.contains(other)) {
    // It does not know yet.
    branches.received(other, member.now);
    send_split(member, other, {member.mission->name, other});
    return {};
  }
  if (!gives_way) {
    rivals_.try_emplace(other, Rival{member.now, member.now}).first->second.last =
        member.now;
    return {};
  }
  const bool counts = !self_fresh && !other_fresh;
  if (!counts || member.knowledge.encounters(self, other) < 1)
    return yield_to(member, other, counts);
  ask_split(member, other);
  return {};
}

bool TeamEncounters::is_held(const MemberState& member) {
  std::erase_if(rivals_, [&](const auto& rival) {
    return member.now - rival.second.last > member.lost;
  });
  return std::ranges::any_of(rivals_, [&](const auto& rival) {
    return member.now - rival.second.first <= member.exchange_time();
  });
}

TeamTransition TeamEncounters::yield_to(MemberState& member, EntityId other,
                                        bool counted) {
  const std::uint32_t times =
      member.knowledge.encounters(member.self, other) + (counted ? 1 : 0);
  const TeamEncounter encounter = encounter_of(member.self, other, times);
  member.knowledge.note(encounter);
  member.outbox.report(EventKind::kTeamMerged,
                       fmt::format("with the team of {}.", other.value),
                       {.other = other});
  send_knowledge(member);
  member.outbox.repeat(other,
                       TeamMerge{*member.mission, encounter, false, member.members},
                       kMerges, member.now + member.exchange_time());
  return FollowOther{other, TeamReason::kMerged};
}

void TeamEncounters::ask_split(MemberState& member, EntityId other) {
  if (!asked_) {
    asked_ = Asked{other, member.now, member.now, {}};
    send_knowledge(member);
  }
  asked_->last = member.now;
  const auto times = member.knowledge.encounters(member.self, other) + 1;
  member.outbox.send(
      other, TeamMerge{*member.mission, encounter_of(member.self, other, times), true,
                       member.members});
}

void TeamEncounters::step(MemberState& member) {
  if (asked_ && member.now - asked_->first > member.exchange_time()) asked_.reset();
  if (asked_ && member.now - asked_->last >=
                    std::max(member.repeat_after(), member.times().query_period / 2))
    ask_split(member, asked_->of);
}

void TeamEncounters::answer_split(MemberState& member, EntityId other,
                                  const TeamMerge& merge, std::span<const TeamTask> tasks,
                                  std::span<const TeamWorker> own,
                                  TeamBranches& branches) {
  const EntityId self = member.self;
  const TeamMission theirs{member.mission->name, other};
  if (member.mission->branch == self &&
      (split_with_.contains(other) ||
       std::ranges::any_of(member.knowledge.tasks, [other](const auto& task) {
         return task.second.branch == other;
       })))
    return send_split(member, other, theirs);
  const auto second = workers_of(member, other, merge.members);
  const auto ours = member.config.divide(tasks, own, second);
  for (const TeamTask& task : tasks)
    member.knowledge.tasks.at(task.number).branch =
        ours.contains(task.number) ? self : other;
  rivals_.erase(other);
  split_with_.insert(other);
  branches.received(other, member.now + member.round_trip);  // until it knows
  branches.received(self, member.now);
  begin_branch(member, other, {member.mission->name, self}, merge.meeting);
  send_split(member, other, theirs);
}

void TeamEncounters::on(MemberState& member, EntityId from, const TeamSplit& split,
                        TeamBranches& branches) {
  const bool waits = asked_ && asked_->of == from &&
                     member.mission->name == split.mission.name &&
                     split.mission.branch == member.self;
  if (!waits) {
    // The last answers to a question that was repeated.
    if (member.leads() && member.mission == split.mission) return;
    return member.outbox.report(EventKind::kTeamAnswerRefused,
                                fmt::format("{} was not asked for a split.", from.value),
                                {.other = from});
  }
  asked_->parts[split.part] = split.tasks;
  if (asked_->parts.size() < split.parts) return;
  std::vector<TeamTask> all;
  for (const auto& [part, tasks] : asked_->parts)
    all.insert(all.end(), tasks.begin(), tasks.end());
  member.knowledge.divide(all);
  // What the other one does not know stays here.
  for (auto& [number, task] : member.knowledge.tasks)
    if (!task.done && !task.branch) task.branch = member.self;
  asked_.reset();
  rivals_.erase(from);
  member.outbox.drop_repeated_to(from);
  for (const auto& [number, task] : member.knowledge.tasks)
    if (task.branch) branches.received(*task.branch, member.now);
  begin_branch(member, from, split.mission, split.meeting);
}

}  // namespace skein::reasoning
