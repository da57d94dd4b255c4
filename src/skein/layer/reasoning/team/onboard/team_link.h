// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>

#include "skein/data/vehicle/agent_step.h"
#include "skein/layer/reasoning/team/protocol/team_member.h"

namespace skein::reasoning {

/// A member of a team on the radio of a run: gives it what has arrived, sends what it
/// says, and records who leads it, and why, whenever that changes. Its events are called
/// as those of TeamMember, with "team-" before; those of a station's operator about
/// allocations keep their names.
///
/// A message to all arrives as one copy for each receiver. So that these know it from one
/// that is for them alone, whose numbers count by themselves, the latter have the highest
/// bit of TeamMessage::number set.
class TeamLink {
 public:
  /// @param config  whose `known` says who may be in the team: others have teams of their
  ///                own, and what they say to all is not looked at.
  TeamLink(EntityId self, const TeamConfig& config)
      : known_(config.known), member_(self, config) {}

  void step(const AgentInput& in, AgentOutput& out);

  TeamMember& member() { return member_; }
  const TeamMember& member() const { return member_; }

 private:
  std::set<EntityId> known_;
  TeamMember member_;
};

}  // namespace skein::reasoning
