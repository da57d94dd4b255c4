// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/branches.h"

#include <fmt/format.h>

#include <algorithm>

namespace skein::reasoning {

void TeamBranches::clear() {
  received_.clear();
  taken_back_.clear();
}

void TeamBranches::step(MemberState& member) {
  const TeamMission& mission = *member.mission;
  const auto is_lost = [&member](double at) { return member.now - at > member.lost; };
  for (const auto& [number, task] : member.knowledge.tasks)
    if (task.branch) received_.try_emplace(*task.branch, member.now);
  std::set<EntityId> taken;
  if (mission.branch) {
    const bool is_lowest = std::ranges::none_of(received_, [&](const auto& other) {
      return other.first < *mission.branch && !is_lost(other.second);
    });
    for (const auto& [branch, at] : received_)
      if (is_lowest && branch != *mission.branch && is_lost(at)) taken.insert(branch);
  }
  if (taken == taken_back_) return;
  for (const EntityId branch : taken)
    if (!taken_back_.contains(branch))
      member.outbox.report(
          EventKind::kTeamTookBack,
          fmt::format("tasks of the lost {}/{}.", mission.name, branch.value),
          {.other = branch});
  for (const EntityId branch : taken_back_)
    if (!taken.contains(branch))
      member.outbox.report(EventKind::kTeamGaveBack,
                           fmt::format("tasks of {}/{}.", mission.name, branch.value),
                           {.other = branch});
  taken_back_ = std::move(taken);
  member.allocation_due = true;
}

bool TeamBranches::receives_any(const MemberState& member) const {
  const auto& own = member.mission->branch;
  return own && std::ranges::any_of(received_, [&](const auto& other) {
           return other.first != own && member.now - other.second <= member.lost;
         });
}

std::vector<TeamTask> TeamBranches::open_tasks(const MemberState& member) const {
  std::vector<TeamTask> all = member.knowledge.open();
  const auto& own = member.mission->branch;
  std::erase_if(all, [&](const TeamTask& task) {
    return own && task.branch && task.branch != own &&
           !taken_back_.contains(*task.branch);
  });
  return all;
}

}  // namespace skein::reasoning
