#pragma once

#include <cstdint>
#include <optional>

#include "skein/base/id.h"
#include "skein/data/agent_step.h"

namespace skein::reasoning {

/// How far an aircraft is with what it has been asked to do.
struct TaskProgress {
  std::uint32_t number = 0;  ///< of the task; 0: none was received
  bool done = false;
};

/// Reports to the ground station where an aircraft is and what it does, evenly in time.
class StatusReport {
 public:
  /// @param period  between two reports [s].
  StatusReport(EntityId station, double period) : station_(station), period_(period) {}

  /// To be called at each step; needs in.nav.
  /// @param zone_changes  it acknowledges the changes of zones up to this number.
  /// @returns             whether it has reported.
  bool step(const AgentInput& in, const FlightLimits& limits,
            const TaskProgress& progress, std::uint32_t zone_changes, AgentOutput& out);

 private:
  EntityId station_;
  double period_;
  std::optional<Time> next_;
};

}  // namespace skein::reasoning
