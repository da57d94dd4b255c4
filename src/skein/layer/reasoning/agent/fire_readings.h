#pragma once

#include <span>
#include <vector>

#include "skein/data/agent_step.h"
#include "skein/data/fire.h"

namespace skein::reasoning {

/// Places what the fire sensor of an aircraft says by the estimated position, and sends
/// and records it.
class FireReadings {
 public:
  FireReadings(EntityId self, EntityId station) : self_(self), station_(station) {}

  /// To be called at each step; needs in.nav.
  void step(const AgentInput& in, AgentOutput& out);

  /// Those of the last step.
  std::span<const FireReading> latest() const { return latest_; }

 private:
  EntityId self_, station_;
  std::vector<FireReading> latest_;
};

}  // namespace skein::reasoning
