#pragma once

#include <memory>
#include <vector>

#include "skein/role/agent.h"

namespace skein::reasoning {

/// A ground station's agent that also gives signs of life: a short message to each
/// aircraft of its team every `period`, so that their autopilots know that the link
/// stands.
class Heartbeat final : public Agent {
 public:
  /// @param station  what reasons on the ground.
  /// @param period   above 0.
  Heartbeat(std::unique_ptr<Agent> station, std::vector<EntityId> team, Time period);

  void step(const AgentInput& in, AgentOutput& out) override;
  const BoundaryEstimate* perimeter() const override { return station_->perimeter(); }

 private:
  std::unique_ptr<Agent> station_;
  std::vector<EntityId> team_;
  Time period_, next_;
};

}  // namespace skein::reasoning
