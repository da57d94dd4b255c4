// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/role/path_planner.h"

namespace skein::solve {

/// Who flies which lines of a survey.
struct SurveyShares {
  /// Begin and end of each line, in the order of each aircraft [m].
  std::vector<std::vector<Vec2>> lines;
  std::vector<double> durations;  ///< of each aircraft's flight [s]
};

/// Shares the lines that are left of a survey among aircraft and orders them, so that all
/// are done as early as possible (line_sharing.h).
/// @param ends    begin and end of each line [m]; either may be flown first.
/// @param starts  where the aircraft are.
/// @param limits  of each of them.
/// @returns       empty lists where the wind is as strong as the airspeed.
SurveyShares share_survey(std::span<const Vec2> ends,
                          const std::vector<FlightState>& starts,
                          const FlightLimits& limits, const Vec2& wind);

}  // namespace skein::solve
