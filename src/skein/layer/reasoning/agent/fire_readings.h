#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skein/data/agent_step.h"
#include "skein/data/fire.h"
#include "skein/layer/reasoning/agent/report_rate.h"

namespace skein::reasoning {

/// Places what the fire sensor of an aircraft says by the estimated position, and sends
/// and records it.
///
/// Where the air has no room for all readings, those on both sides of a change are sent,
/// as they say where the fire's edge is, and a share of the others, evenly; the first
/// ones, when all have more to say, later.
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
  EntityId self_, station_;
  std::optional<FireReading> last_;
  bool last_sent_ = false;
  std::vector<FireReading> to_send_;
  double credit_;  // of readings that may be sent
  std::vector<FireReading> latest_;
};

}  // namespace skein::reasoning
