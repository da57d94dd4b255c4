// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "skein/base/id.h"
#include "skein/layer/reasoning/agent/task_planner.h"

namespace skein::reasoning {

/// Reports to the ground station where an aircraft is and what it does, evenly in time.
///
/// Where the air has no room for all reports, they are rarer and say when the next one
/// comes, as far as is known then; a new order or the end of one is reported at once.
class StatusReport {
 public:
  /// @param period  between two reports [s].
  StatusReport(EntityId self, EntityId station, double period)
      : self_(self), station_(station), period_(period) {}

  /// To be called at each step; needs in.nav.
  /// @param zone_changes  it acknowledges the changes of zones up to this number.
  /// @param share         of the reports that the air has room for, above 0, at most 1.
  /// @returns             whether it has reported.
  bool step(const AgentInput& in, const FlightLimits& limits, const TaskPlanner& tasks,
            std::uint32_t zone_changes, double share, AgentOutput& out);

 private:
  bool is_due(const TaskPlanner& tasks, double share) const;
  void pass(Time now, double share);

  EntityId self_, station_;
  double period_;
  std::uint32_t reports_ = 0;
  std::uint32_t said_order_ = 0;  // in the last report
  TaskState said_state_ = TaskState::kNone;
  std::optional<Time> last_;  // step
  Time left_;                 // until the next report, if there were room for all
};

}  // namespace skein::reasoning
