// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/execution_monitor.h"

#include <fmt/format.h>

#include <cmath>

namespace skein::reasoning {
namespace {

SafetyZone half(const SafetyZone& zone) {
  return {zone.ahead / 2, zone.behind / 2, zone.across / 2};
}

}  // namespace

std::optional<Event> ExecutionMonitor::check(Time now, EntityId self,
                                             const AutopilotStatus& status) {
  if (!status.follows) {
    off_ = false;  // what is no longer flown is not off any more
    return std::nullopt;
  }
  const ExecutionError error{status.time_error, status.cross_track};
  const bool off = off_ ? !within(half(zone_), error) : !within(zone_, error);
  if (off == off_) return std::nullopt;
  off_ = off;
  // A path has no times to be late for.
  const std::string late =
      error.time == 0 ? ""
                      : fmt::format("{:.1f} s {} the plan, ", std::abs(error.time),
                                    error.time < 0 ? "ahead of" : "behind");
  return Event{now,
               self,
               off ? EventKind::kOffPlan : EventKind::kOnPlan,
               fmt::format("{}{:.1f} m off the path", late, std::abs(error.across)),
               {.value = std::abs(error.across)}};
}

}  // namespace skein::reasoning
