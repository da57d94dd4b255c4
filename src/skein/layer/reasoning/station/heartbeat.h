// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "skein/data/vehicle/agent_step.h"

namespace skein::reasoning {

/// Sends heartbeats: a short message to each aircraft of a ground station every `period`,
/// so that their autopilots know that the link stands.
class HeartbeatSender {
 public:
  /// @param period  0: none are sent.
  HeartbeatSender(std::vector<EntityId> team, Time period)
      : team_(std::move(team)), period_(period) {}

  void step(Time now, AgentOutput& out);

 private:
  std::vector<EntityId> team_;
  Time period_, next_;
};

}  // namespace skein::reasoning
