// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/data/airspace/airspace.h"
#include "skein/role/path_planner.h"

namespace skein::reasoning {

/// The flight from a time on, planned around what is in its way, and what comes of the
/// plan after that: it is met again at `rejoins` and flown as much later as that takes
/// longer (solve::repair).
///
/// @param begin, rejoins  times of the plan [s].
/// @param query     limits and ground count; start, goal and wind are the plan's.
/// @param airspace  that is to be kept out of.
/// @returns  none where there is no other flight, or the plan is free.
/// Cost: a thousand expansions at most.
std::optional<FlightPlan> replanned(const FlightPlan& plan, double begin, double rejoins,
                                    PathQuery query, const Airspace& airspace);

/// Adds what a plan has after a time to the end of a flight, moved to where that ends.
void append_rest(FlightPlan& flight, const FlightPlan& plan, double rejoins);

}  // namespace skein::reasoning
