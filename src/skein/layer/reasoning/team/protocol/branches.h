// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <vector>

#include "skein/layer/reasoning/team/protocol/member_state.h"

namespace skein::reasoning {

/// What a leader knows of the other branches of a mission that was split: when each was
/// received, and which are lost, so that the lowest branch that is there takes back their
/// tasks.
class TeamBranches {
 public:
  void clear();
  /// @param at  [s]
  void received(EntityId branch, double at) { received_[branch] = at; }
  /// Takes back tasks of branches that are lost, and gives them back.
  void step(MemberState& member);
  /// Whether another branch is there.
  bool receives_any(const MemberState& member) const;
  /// The open tasks of the own branch, and those taken back.
  std::vector<TeamTask> open_tasks(const MemberState& member) const;

 private:
  std::map<EntityId, double> received_;  // of each branch, when [s]
  std::set<EntityId> taken_back_;        // branches whose tasks it has taken
};

}  // namespace skein::reasoning
