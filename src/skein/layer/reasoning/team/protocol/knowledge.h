// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "skein/data/team/team_message.h"

namespace skein::reasoning {

/// What a member knows of its mission: tasks, and which leaders have met.
class TeamKnowledge {
 public:
  std::map<std::uint32_t, TeamTask> tasks;

  void submit(std::span<const TeamTask> all);

  /// The operator does not want a task any more.
  /// @returns  false when it is not known, or over.
  bool withdraw(std::uint32_t task);

  /// A task is done.
  /// @returns  whether that is news: it is known here, and was not over.
  bool finish(std::uint32_t task);
  /// Whether a task is known to be done or withdrawn.
  bool is_over(std::uint32_t task) const;
  /// Tasks that are not over; of TeamTask::after what is not over.
  std::vector<TeamTask> open() const;

  /// How often two leaders have met.
  std::uint32_t encounters(EntityId a, EntityId b) const;
  /// The larger number of encounters counts.
  void note(const TeamEncounter& encounter);

  /// Of the tasks: the same in whoever knows the same.
  std::uint32_t number() const;

  /// One part of what there is to say, in turn.
  TeamState part(std::uint32_t index, std::vector<EntityId> members) const;
  /// The part after the one that was last asked for by this.
  TeamState next_part(std::vector<EntityId> members) {
    return part(next_part_++, std::move(members));
  }
  std::uint32_t parts() const;

  /// Takes in a part of the leader's; what it says replaces all when the last is there.
  /// But what is done, withdrawn or approved stays so, and tasks that the leader lacks
  /// are kept.
  void take(const TeamState& state);
  /// The leader has said these tasks: what it does not know of them is news to it.
  void compare(std::span<const TeamTask> leaders);
  /// What it knows and the leader does not, as much as one message holds; without tasks:
  /// nothing.
  TeamState news() const;
  /// Another one is the leader.
  void forget_leader();
  /// Takes from a part what is new here: tasks, those that are done or approved,
  /// encounters.
  /// @param branch  that new tasks belong to when they belong to none.
  /// @returns  whether tasks have changed.
  bool add(const TeamState& state, std::optional<EntityId> branch);
  /// Takes from a part of another branch what is new here. A task that both claim is that
  /// of the lower branch.
  /// @returns  whether tasks have changed.
  bool add_of_branch(const TeamState& state, EntityId theirs, EntityId own);
  /// Takes in tasks as the split of the mission divides them.
  void divide(std::span<const TeamTask> divided);

 private:
  std::map<std::pair<EntityId, EntityId>, std::uint32_t> met_;
  struct Incoming {
    std::uint32_t number = 0;
    std::map<std::uint32_t, std::vector<TeamTask>> parts;
  };
  Incoming incoming_;
  std::uint32_t next_part_ = 0;
  std::set<std::uint32_t> news_;  // tasks of which the leader knows less
};

/// The ids of members as one number.
std::uint32_t hash_of_members(const std::vector<EntityId>& members);

}  // namespace skein::reasoning
