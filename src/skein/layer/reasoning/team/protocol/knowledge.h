#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "skein/data/team_message.h"

namespace skein::reasoning {

/// What a member knows of its mission: tasks, and which masters have met.
class TeamKnowledge {
 public:
  std::map<std::uint32_t, TeamTask> tasks;

  void submit(std::span<const TeamTask> all);

  /// How often two masters have met.
  std::uint32_t meetings(EntityId a, EntityId b) const;
  /// The larger number of meetings counts.
  void note(const TeamMeeting& meeting);

  /// Of the tasks: the same in whoever knows the same.
  std::uint32_t number() const;

  /// One part of what there is to say, in turn.
  TeamState part(std::uint32_t index, std::vector<EntityId> members) const;
  std::uint32_t parts() const;

  /// Takes in a part of the master's; what it says replaces all when the last is there.
  void take(const TeamState& state);
  /// Takes from a part what is new here: tasks, those that are done or approved,
  /// meetings.
  /// @returns  whether tasks have changed.
  bool add(const TeamState& state);

 private:
  std::map<std::pair<EntityId, EntityId>, std::uint32_t> met_;
  struct Incoming {
    std::uint32_t number = 0;
    std::map<std::uint32_t, std::vector<TeamTask>> parts;
  };
  Incoming incoming_;
};

/// The ids of members as one number.
std::uint32_t hash_of_members(const std::vector<EntityId>& members);

}  // namespace skein::reasoning
