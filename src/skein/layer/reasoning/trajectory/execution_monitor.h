// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/base/id.h"
#include "skein/data/event/event.h"
#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/safety_zone.h"

namespace skein::reasoning {

/// Watches how a plan or path is carried out: reports when the errors leave the safety
/// zone, and when they are back within half of it, so that an error at the border is
/// reported once.
class ExecutionMonitor {
 public:
  explicit ExecutionMonitor(const SafetyZone& zone) : zone_(zone) {}

  /// @param status  of the autopilot; nothing is judged where it follows nothing.
  /// @returns       an event "off-plan" or "on-plan" when that has changed.
  std::optional<Event> check(Time now, EntityId self, const AutopilotStatus& status);

  bool off_plan() const { return off_; }

 private:
  SafetyZone zone_;
  bool off_ = false;
};

}  // namespace skein::reasoning
