// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/geo/polygon.h"
#include "skein/solve/coverage/watch.h"
#include "skein/solve/coverage/zone_lines.h"

namespace skein::solve {

/// Where lines end before zones, so that there is room to turn, some of the area is left
/// unseen. What is needed to see it from other lines.
struct GapTask {
  const geo::Region& area;  ///< clean, without the zones
  const ZoneRings& zones;
  double spacing = 100;      ///< lines see half of it on either side [m]
  double bearing = 0;        ///< of the lines that there are [rad]
  double turn_length = 100;  ///< flown from one line to another, roughly [m]
  double overshoot = 0;      ///< lines are this much longer at both ends [m]
  ZoneRoom room;             ///< of lines to zones
  Stop stop = {};            ///< true: no more lines
};

/// What lies beside lines, at most `half` away: a rectangle for each, all positive. They
/// are 1 mm larger on each side, against the rounding of lines that only just touch.
geo::Region beside(const std::vector<SweepLine>& lines, double half);

/// Lines that see gaps.
struct GapLines {
  /// Clear of the zones, mostly along their borders; each is a cell of its own, numbered
  /// on from the given lines.
  std::vector<SweepLine> lines;
  double unseen = 0;  ///< area that they do not see either, but some line might [m^2]
};

/// Lines through what the given ones leave unseen.
///
/// Parts that are near to each other are swept at some bearings: along borders nearby,
/// across the path into corners, across the given lines. Of each sweep the lines count
/// that see much for their length and a turn, and those at the bearing that sees most are
/// kept. So on while more is seen that is worth a line, for at most 12 iterations.
GapLines gap_lines(const GapTask& task, const std::vector<SweepLine>& lines);

}  // namespace skein::solve
