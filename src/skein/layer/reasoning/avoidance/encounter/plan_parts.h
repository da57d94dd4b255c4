// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "skein/data/vehicle/flight_plan.h"

namespace skein::reasoning {

/// When an element ends [s].
inline double end_of(const FlightElement& e) {
  return e.start + e.duration;
}

/// The first element that lasts beyond a time [s].
inline FlightPlan::const_iterator from_time(const FlightPlan& plan, double time) {
  return std::ranges::partition_point(
      plan, [&](const FlightElement& e) { return end_of(e) <= time; });
}

}  // namespace skein::reasoning
