// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "skein/solve/path/airspace_map.h"

namespace skein::solve {

/// What one aircraft of a fleet wants to fly.
struct FleetMember {
  EntityId who;
  FlightState start, goal;
  double earliest_start = 0;  ///< [s]
  /// It may stay where it takes no room until then [s]; equal to the earliest for an
  /// aircraft in flight.
  double latest_start = 0;
  FlightLimits limits;
};

/// What all of a fleet share. Start, goal, start time and limits of `common` are not
/// used, its budget is that of each search for a detour.
struct FleetQuery {
  PathQuery common;
  std::vector<FleetMember> members;  ///< those of higher priority first
  SafetyZone zone;                   ///< room of each planned flight
  double height = 20;                ///< of that room, up and down [m]
};

/// Flights in the order of the members.
struct FleetPlan {
  std::vector<PlannedPath> paths;  ///< plans begin when each starts
  std::size_t planned = 0;         ///< how many have one
};

/// Prioritised planning: each aircraft plans around the flights of those before it. Where
/// some find no flight all is planned anew with these first, four times at most, and the
/// plan with the most flights is taken. An aircraft takes the earliest arrival among
/// going straight at once, starting later, and swerving or searching for a path at once
/// or later.
///
/// No two planned flights come into each other's rooms, whichever was planned first: for
/// those that plan later a room reaches in both directions of time as far as the longer
/// of `ahead` and `behind`.
///
/// Where the budget's `stop` ends it, those that were not planned by then have no flight.
///
/// Cost: of N aircraft N searches, each of which looks at the flights near its own only.
FleetPlan plan_fleet(const FleetQuery& query);

}  // namespace skein::solve
