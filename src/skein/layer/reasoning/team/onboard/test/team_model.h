// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "skein/layer/reasoning/team/onboard/test/team_world.h"

namespace skein::reasoning {

/// What must be true of a team whose radio was quiet for one re-selection, by the truth
/// of its world. In each group of members that receive each other:
///
/// - all name one leader, who is among them. Where the mission was split, as leaders met
///   for the second time, each branch has one;
/// - all know the same: each task that any of them was told, and which ones are done;
/// - who is able to and has no task leaves none that it could fly to nobody;
/// - no single task is flown by two, and none that one of them knows to be done, nor one
///   that comes after a task which is not over.
///
/// With sequences a member may have none while all that could be flown is in the orders
/// of others, who fly it later.
///
/// In an auction nobody leads. Without its station a group with a fixed master has nobody
/// to lead it, and where the operator approves what is flown it may have nothing to fly.
class TeamModel {
 public:
  TeamModel(TeamWorld& world, const TeamConfig& config, TaskSharing sharing)
      : world_(world),
        structure_(config.structure),
        approval_(config.approval),
        may_wait_(sharing == TaskSharing::kSequences) {}

  /// Looks at all groups; from now on their members have been told what any of them was.
  /// @returns  what is wrong.
  std::vector<std::string> look() {
    wrong_ = std::exchange(world_.faults, {});
    look_at_splits();
    std::map<std::size_t, std::vector<EntityId>> groups;
    for (const auto& [id, known] : world_.informed)
      if (world_.air.has(id)) groups[world_.air.group_of(id)].push_back(id);
    for (const auto& [number, members] : groups) look_at_group(members);
    return wrong_;
  }

 private:
  using Members = std::vector<EntityId>;

  static std::string text(EntityId id) { return std::to_string(id.value); }
  void say(EntityId id, const std::string& what) {
    wrong_.push_back(text(id) + " " + what);
  }
  bool flies(EntityId id) const { return world_.aircraft.contains(id); }
  const TeamStatus& status(EntityId id) const {
    return world_.aircraft.at(id).team->member().status();
  }
  std::optional<EntityId> master_of(EntityId id) const {
    return flies(id) ? status(id).master : world_.master_of_station;
  }

  // Masters that meet for the first time become one team.
  void look_at_splits() {
    for (; next_event_ < world_.events.size(); ++next_event_) {
      const Event& event = world_.events[next_event_];
      if (event.kind != EventKind::kTeamSplit) continue;
      const EntityId other = event.numbers.other.value();
      const std::pair<EntityId, EntityId> pair = std::minmax(event.entity, other);
      const auto met = world_.encounters.find(pair);
      if (met == world_.encounters.end() || met->second < 2)
        say(event.entity, "splits the mission with " + std::to_string(other.value) +
                              ", whom it has not met before");
    }
  }

  bool is_of_mission(EntityId id) const {
    return world_.informed.at(id).of_mission || (flies(id) && status(id).mission);
  }

  std::string team_of(EntityId leader) const {
    if (!flies(leader)) return world_.team_of_station;
    const auto& mission = status(leader).mission;
    return mission ? name_of(*mission) : "none";
  }

  void look_at_group(const Members& group) {
    // Newcomers by themselves have nobody to lead them, and nothing to do.
    if (std::ranges::none_of(group, [&](EntityId id) { return is_of_mission(id); }))
      return;
    const bool has_station = std::ranges::find(group, TeamWorld::kStation) != group.end();
    if (structure_ == TeamStructure::kFixedMaster && !has_station) return;
    if (structure_ == TeamStructure::kAuction) {
      look_at_flown(group);
      inform(group);
      return look_at_idle(group.front(), group, group, true);
    }
    std::map<EntityId, Members> teams;
    for (const EntityId id : group) {
      const auto master = master_of(id);
      if (!master) say(id, "follows nobody");
      if (!master) continue;
      if (std::ranges::find(group, *master) == group.end() ||
          master_of(*master) != master)
        say(id, "follows " + text(*master) + ", who does not lead here");
      teams[*master].push_back(id);
    }
    look_at_leaders(teams);
    look_at_flown(group);
    inform(group);
    if (approval_ && !has_station) return;
    for (const auto& [leader, members] : teams)
      look_at_idle(leader, members, group, teams.size() == 1);
  }

  void look_at_leaders(const std::map<EntityId, Members>& teams) {
    if (teams.size() < 2) return;
    std::set<std::string> branches;
    for (const auto& [leader, members] : teams) {
      const auto team = team_of(leader);
      if (team.find('/') == std::string::npos || !branches.insert(team).second)
        say(leader, "leads " + team + " besides another");
    }
  }

  void look_at_flown(const Members& group) {
    std::map<std::uint32_t, EntityId> flown;
    for (const EntityId id : group) {
      if (!flies(id)) continue;
      const auto task = world_.flown_by(id);
      if (!task) continue;
      if (!world_.is_able(id)) say(id, "is not able, but has a task");
      for (const std::uint32_t before : world_.wanted.at(*task).after)
        if (!world_.done.contains(before))
          say(id, "flies " + std::to_string(*task) + " before " + std::to_string(before));
      const auto [other, is_first] = flown.try_emplace(*task, id);
      if (!is_first && !world_.wanted.at(*task).group)
        say(id, "and " + text(other->second) + " fly task " + std::to_string(*task));
    }
  }

  // All of a group know what one of them knows.
  void inform(const Members& group) {
    TeamWorld::Informed all;
    for (const EntityId id : group) {
      const TeamWorld::Informed& one = world_.informed.at(id);
      all.tasks.insert(one.tasks.begin(), one.tasks.end());
      all.done.insert(one.done.begin(), one.done.end());
    }
    all.of_mission = true;
    for (const EntityId id : group) {
      world_.informed.at(id) = all;
      if (!flies(id)) continue;
      const auto& known = world_.aircraft.at(id).team->member().knowledge().tasks;
      for (const std::uint32_t task : all.tasks) {
        const auto found = known.find(task);
        const bool is_done = all.done.contains(task);
        if (found == known.end())
          say(id, "does not know task " + std::to_string(task));
        else if (is_done && !found->second.done)
          say(id, "does not know that task " + std::to_string(task) + " is done");
        else if (found->second.done && !world_.done.contains(task))
          say(id, "takes task " + std::to_string(task) + " for done");
      }
      const auto task = world_.flown_by(id);
      if (task && all.done.contains(*task))
        say(id, "flies task " + std::to_string(*task) + " that is done");
    }
  }

  // Of a split mission a team's are those of its branch, and of branches that are away.
  bool is_theirs(EntityId leader, std::uint32_t task, bool is_only_team) const {
    if (is_only_team || !flies(leader)) return true;
    const auto& known = world_.aircraft.at(leader).team->member().knowledge().tasks;
    const auto found = known.find(task);
    return found != known.end() && found->second.branch == status(leader).mission->branch;
  }

  // What it comes after is over, as an entity has heard.
  bool is_ready(std::uint32_t task, const TeamWorld::Informed& known) const {
    return std::ranges::all_of(world_.wanted.at(task).after, [&](std::uint32_t before) {
      return known.done.contains(before);
    });
  }

  void look_at_idle(EntityId leader, const Members& team, const Members& group,
                    bool is_only_team) {
    std::set<std::uint32_t> flown;
    for (const EntityId id : group) {
      if (flies(id) && world_.flown_by(id)) flown.insert(*world_.flown_by(id));
      if (!flies(id) || !may_wait_) continue;
      const auto& ordered = world_.aircraft.at(id).team->member().tasks();
      flown.insert(ordered.begin(), ordered.end());
    }
    for (const EntityId id : team) {
      if (!flies(id) || world_.flown_by(id) || !world_.is_able(id)) continue;
      const auto& known = world_.informed.at(id);
      for (const std::uint32_t task : known.tasks)
        if (!world_.done.contains(task) && !flown.contains(task) &&
            is_ready(task, known) && world_.can_fly(id, task) &&
            is_theirs(leader, task, is_only_team))
          say(id, "has no task while " + std::to_string(task) + " is free");
    }
  }

  TeamWorld& world_;
  TeamStructure structure_;
  bool approval_, may_wait_;
  std::size_t next_event_ = 0;
  std::vector<std::string> wrong_;
};

}  // namespace skein::reasoning
