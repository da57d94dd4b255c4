#pragma once

#include <span>
#include <vector>

#include "skein/data/flight_plan.h"
#include "skein/data/vehicle.h"
#include "skein/role/path_planner.h"

namespace skein::planning {

/// Shares the lines that are left of a survey among aircraft and orders them, so that all
/// are done as early as possible (line_sharing.h).
/// @param ends    begin and end of each line [m]; either may be flown first.
/// @param starts  where the aircraft are.
/// @param limits  of each of them.
/// @returns       begin and end of each line, in the order of each aircraft; empty ones
///                where the wind is as strong as the airspeed.
std::vector<std::vector<Vec2>> share_survey(std::span<const Vec2> ends,
                                            const std::vector<FlightState>& starts,
                                            const FlightLimits& limits, const Vec2& wind);

}  // namespace skein::planning
