// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/model/connection/connection.h"
#include "skein/role/path_planner.h"

namespace skein::solve {

/// The path from one flight state to another with nothing in between: the exact
/// connection in wind, climbed or sunk evenly, with vertical turns at its begin and end
/// if the climb's acceleration is bounded; where that is too steep, full turns come
/// first, as wide as the time needed makes them.
struct Link {
  model::Connection connection;  ///< after the wait
  double wait = 0;               ///< of the full turns that come first [s]
  double climb = 0;              ///< upwards [m]
  double duration = 0;           ///< with the wait [s]; infinite if there is none
};

/// The link, circling no longer than climbing needs.
/// @param wait  to circle at least before the path is begun [s]: 0 or a full turn or
///              more.
/// Cost: one connection; with circling in wind some more.
Link link(const FlightState& from, const FlightState& to, const PathQuery& query,
          double wait = 0);

/// The link as elements that begin at a time.
FlightPlan to_flight_plan(const Link& link, const FlightState& from, double start,
                          const PathQuery& query);

/// The least time for a climb, upwards positive, within the limits [s].
double climb_time(double climb, const FlightLimits& limits);

/// The same state later, carried on by level full turns that take `time` [s]: one
/// element.
/// Fails: Bug when the time is less than one full turn takes.
FlightElement loiter(const FlightState& from, double start, double time,
                     const PathQuery& query);
/// The duration of one full turn [s].
double full_turn(const PathQuery& query);

/// Whether no flight between the two states is quicker than the link.
bool is_exact(const Link& link);

/// A time that no flight from one state to the other can be quicker than [s], whatever
/// the obstacles: the connection's; where that is irregular, distance / (V + |w|). At
/// least what climbing takes.
double min_time(const Link& link, const FlightState& from, const FlightState& to,
                const PathQuery& query);

/// The state at the end of a plan. Fails: Bug when it is empty.
FlightState state_after(const FlightPlan& plan);
FlightState state_after(const FlightElement& element);

model::AirMotion air_of(const PathQuery& query);

}  // namespace skein::solve
