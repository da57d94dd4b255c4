#pragma once

#include "skein/base/id.h"
#include "skein/data/agent_step.h"

namespace skein::reasoning {

/// Reports the position of an aircraft without orders to the ground station, evenly in
/// time.
class PositionReport {
 public:
  /// @param period  between two reports [s].
  PositionReport(EntityId station, double period) : station_(station), period_(period) {}

  /// To be called at each step; needs in.nav.
  /// @param done          what it flies is over.
  /// @param zone_changes  it acknowledges the changes of zones up to this number.
  void step(const AgentInput& in, const FlightLimits& limits, bool done,
            std::uint32_t zone_changes, AgentOutput& out);

 private:
  EntityId station_;
  double period_;
  Time next_;
};

}  // namespace skein::reasoning
