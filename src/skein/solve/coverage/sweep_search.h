// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/solve/coverage/line_sharing.h"
#include "skein/solve/coverage/watch.h"
#include "skein/solve/coverage/zone_lines.h"

namespace skein::solve {

/// An area to be swept by equal aircraft in one wind.
struct SweepTask {
  geo::Region area;      ///< clean
  double spacing = 100;  ///< largest distance of lines [m]
  double overshoot = 0;  ///< lines are this much longer at both ends [m]
  double joined = 0;     ///< see sweep_lines
  ZoneRings zones;       ///< to keep out of
  ZoneRoom room;         ///< of lines to them
  model::AirMotion air;
  std::vector<RouteEnds> ends;  ///< of each aircraft
  Watch watch = {};
};

/// One sweep of it.
struct Sweep {
  double bearing = 0;  ///< [rad]
  std::vector<SweepLine> lines;
  std::vector<Route> routes;
  double longest = 1e300;  ///< of the routes [s]
  double total = 1e300;    ///< of all routes [s]
  double unseen = 0;       ///< before zones, though some line might see it [m^2]
  double cost = 1e300;     ///< longest, and more for what is unseen [s]
  bool too_many = false;   ///< no solution: more than kMaxLines lines
};

/// Whether a costs less than b, or as much with less flying.
bool better(const Sweep& a, const Sweep& b);

/// Lines at a bearing, clear of zones, each cut into equal pieces, with overshoot.
std::vector<SweepLine> lines_at(const SweepTask& task, double bearing, CellRule rule,
                                int pieces = 1);

/// The best sweep at a bearing, of all rules of division. A few lines for several
/// aircraft are also cut into pieces, so that they can be shared evenly.
Sweep sweep_at(const SweepTask& task, double bearing, const OrderBudget& budget);

/// The best sweep found over all bearings. `longest` is infinite when there are no lines.
/// Stopped by the task's watch it ends with the best so far, which is always one.
Sweep best_sweep(const SweepTask& task);

}  // namespace skein::solve
