// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "skein/solve/target/timed_flight.h"

namespace skein::solve {

/// Several timed flights.
struct Arrivals {
  TimedStatus status = TimedStatus::kNoConnection;
  std::vector<TimedFlight> flights;  ///< in the order of the legs
  std::vector<double> times;         ///< of their arrivals [s]
  double earliest = 0;               ///< see RendezvousResult
};

/// Flights that arrive `spacing` seconds after each other, the first at `first`, or as
/// early as possible. Who can be there first comes first. Needs legs that have a path.
Arrivals arrive_in_order(const std::vector<TimedLeg>& legs, std::optional<double> first,
                         double spacing);

}  // namespace skein::solve
