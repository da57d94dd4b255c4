// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>

#include "skein/base/id.h"
#include "skein/data/vehicle/agent_step.h"

namespace skein::reasoning {

/// Where the others of the team are, by the newest that each, or somebody for it, has
/// reported.
class TeamMemory {
 public:
  /// Takes in what was received.
  void listen(const AgentInput& in);

  /// The newest of all that have reported.
  const std::map<EntityId, NavEstimate>& members() const { return members_; }

  /// The newest of one of them; none: nothing was received.
  std::optional<NavEstimate> find(EntityId id) const;

 private:
  std::map<EntityId, NavEstimate> members_;
};

}  // namespace skein::reasoning
