// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skein/data/perimeter/fire.h"
#include "skein/data/perimeter/fire_report.h"
#include "skein/data/vehicle/agent_step.h"
#include "skein/layer/reasoning/agent/report_rate.h"

namespace skein::reasoning {

/// Places what the fire sensor of an aircraft says by the estimated position, and sends
/// and records it.
///
/// Where the air has no room for all readings, those on both sides of a change are sent,
/// as they say where the fire's edge is, and a share of the others, evenly; with them
/// some places that were seen to burn since the last report, as what has burnt stays so.
class FireReadings {
 public:
  FireReadings(EntityId self, EntityId station)
      : self_(self), station_(station), credit_(ReportRate::phase(self) - 1) {}

  /// To be called at each step; needs in.nav.
  /// @param share  of the readings that the air has room for, above 0, at most 1.
  void step(const AgentInput& in, double share, AgentOutput& out);

  /// Those of the last step.
  std::span<const FireReading> latest() const { return latest_; }

 private:
  void take(const FireReading& reading, double share);
  void remember(const FireReading& reading);
  Message report();

  EntityId self_, station_;
  std::optional<FireReading> last_;
  bool last_sent_ = false;
  double credit_;  // of readings that may be sent
  std::vector<FireReading> latest_;
  struct Selected {
    FireReading reading;
    bool adjacent = false;
  };
  std::vector<Selected> selected_;  // to be sent now
  std::vector<Vec2> burning_;       // seen since the last report and not sent
  double burning_apart_ = 0;        // these are at least so far from each other [m]
};

}  // namespace skein::reasoning
