// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/data/airspace/zone.h"
#include "skein/data/vehicle/flight_plan.h"
#include "skein/solve/coverage/sweep_lines.h"
#include "skein/solve/coverage/zone_rings.h"

namespace skein::solve {

/// What aircraft on lines need beside zones.
struct ZoneRoom {
  double distance = 0;  ///< between lines and zones [m]
  /// Beyond the ends of lines a half turn of this radius to the left or to the right,
  /// over ground, lies outside of zones [m].
  double turn_radius = 0;
};

/// The parts of lines that lie outside of zones and have room to them.
/// Cost: lines times corners.
std::vector<SweepLine> clear_of(const std::vector<SweepLine>& lines,
                                const ZoneRings& zones, const ZoneRoom& room);

/// Time that a plan spends within zones at their altitudes and times, more than 0.1 m
/// from their borders [s], to 0.05 s for each time it enters one.
double time_within(const FlightPlan& plan, const std::vector<Zone>& zones);

}  // namespace skein::solve
