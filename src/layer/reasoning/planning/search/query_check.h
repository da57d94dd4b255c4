#pragma once

#include <optional>

#include "layer/reasoning/planning/search/airspace_map.h"

namespace skein::planning {

/// What is wrong with a query by itself, as an answer: not a number, not positive, wind
/// too strong, zones that cross themselves or run the wrong way, places off the map.
/// Nothing when it can be planned. Cost: quadratic in the corners of each ring.
std::optional<PlannedPath> refuse(const PathQuery& query);

/// Whether the start or the goal is blocked, as an answer with the nearest place that is
/// not. The goal is blocked when it never is free from the earliest arrival on.
std::optional<PlannedPath> refuse_blocked(const AirspaceMap& map,
                                          double earliest_arrival);

}  // namespace skein::planning
