#pragma once

#include <vector>

#include "data/flight_plan.h"
#include "layer/reasoning/planning/tasks/sweep_lines.h"
#include "model/connection/connection.h"

namespace skein::planning {

/// The parts of lines that lie outside of zones and at least `distance` [m] from them.
/// @param zones  positive rings.
/// Cost: lines times corners.
std::vector<SweepLine> clear_of(const std::vector<SweepLine>& lines,
                                const std::vector<geo::Ring>& zones, double distance);

/// Whether the ground track of a plan enters one of the zones, turns taken as chords of
/// 0.1 rad.
bool enters(const FlightPlan& plan, const std::vector<geo::Ring>& zones);

/// Time that a plan spends within zones [s], to 0.05 s for each time it enters one.
double time_within(const FlightPlan& plan, const std::vector<geo::Ring>& zones);

}  // namespace skein::planning
