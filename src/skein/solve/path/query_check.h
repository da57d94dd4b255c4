// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/solve/path/airspace_map.h"

namespace skein::solve {

/// What is wrong with a query but for its airspace, as an answer: not a number, not
/// positive, wind too strong, places off the map. Nothing when it can be planned.
std::optional<PlannedPath> refuse_flight(const PathQuery& query);

/// What is wrong with the airspace of a query: zones that cross themselves or run in the
/// wrong sense, no numbers. A map can be made of what is not refused.
/// Cost: quadratic in the corners of each ring.
std::optional<PlannedPath> refuse_airspace(const PathQuery& query);

/// Whether the start or the goal is blocked, as an answer with the nearest place that is
/// not. The goal is blocked when it never is free from the earliest arrival on.
std::optional<PlannedPath> refuse_blocked(const AirspaceMap& map,
                                          double earliest_arrival);

}  // namespace skein::solve
