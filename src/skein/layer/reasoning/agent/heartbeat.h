#pragma once

#include <memory>
#include <vector>

#include "skein/role/agent.h"

namespace skein::reasoning {

/// A ground station's agent that also sends heartbeats: a short message to each
/// aircraft of its team every `period`, so that their autopilots know that the link
/// stands.
class HeartbeatSender final : public Agent {
 public:
  /// @param station  what reasons on the ground.
  /// @param period   above 0.
  HeartbeatSender(std::unique_ptr<Agent> station, std::vector<EntityId> team,
                  Time period);

  void step(const AgentInput& in, AgentOutput& out) override;

 private:
  std::unique_ptr<Agent> station_;
  std::vector<EntityId> team_;
  Time period_, next_;
};

}  // namespace skein::reasoning
