// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "skein/data/team/team_message.h"

namespace skein::reasoning {

class TeamKnowledge;

/// What a member can do, the tasks that it executes, how far it is with them, and those
/// that it leaves to members of other teams.
class OwnTasks {
 public:
  void set_resources(const TeamResources& resources);
  /// As given, and what it leaves to others among what it refuses.
  const TeamResources& resources() const { return resources_; }

  /// Whoever is not able executes nothing.
  /// @returns  whether it executes others than before.
  bool execute(std::vector<std::uint32_t> tasks);
  const std::vector<std::uint32_t>& executing() const { return executing_; }
  bool executes(std::uint32_t task) const;

  /// @param share  that is done, from 0 to 1.
  void set_progress(std::uint32_t task, double share) { progress_[task] = share; }
  bool has_done(std::uint32_t task) const;
  /// Numbers of the tasks that it has done.
  std::vector<std::uint32_t> done() const;
  /// Of what it executes, and of what it has done and others do not know to be done.
  std::vector<TeamProgress> progress(const TeamKnowledge& knowledge) const;

  void yield(std::uint32_t task, EntityId to) { yielded_[task] = to; }
  bool has_yielded(std::uint32_t task) const { return yielded_.contains(task); }
  /// Refuses what it leaves to others, and takes back what they do not fly any more.
  void renew_refusals(
      const std::function<bool(std::uint32_t task, EntityId other)>& still_flies);

 private:
  TeamResources resources_;
  std::vector<std::uint32_t> refused_as_given_;
  std::vector<std::uint32_t> executing_;
  std::map<std::uint32_t, double> progress_;
  std::map<std::uint32_t, EntityId> yielded_;  // tasks, and to whom
};

}  // namespace skein::reasoning
