// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/geo/polygon.h"

namespace skein::solve {

/// A straight line over ground that is flown, in one of its two directions, so that a
/// sensor sees what lies beside it.
struct SweepLine {
  Vec2 a = Vec2::Zero(), b = Vec2::Zero();  ///< ends; b lies towards the bearing [m]
  int cell = 0;  ///< lines of one cell lie side by side, in the order of the list
};

inline constexpr int kMaxLines = 1000;  ///< that a survey may have

/// How an area that is not convex is divided before it is swept.
enum class CellRule {
  kCommonLines,  ///< each connected part as a whole: its bands go through all cells
  kSplit,        ///< cells of its own lines between places where the cut divides or joins
  kSplitAtJumps,  ///< also where the cut suddenly becomes much longer or shorter
};

/// Parallel lines that sweep an area.
///
/// The area is cut into trapezoids by lines along `bearing` through all corners.
/// Trapezoids that join make cells, in which each cut along the bearing is one interval
/// (boustrophedon decomposition, [Choset00]). A cell that is W wide is divided into
/// ceil(W / spacing) bands of equal width; the line of a band runs in its middle, from
/// the first to the last point that the area has within the band. So every point of the
/// area lies beside a line, at most spacing / 2 from it.
///
/// @param area     clean: no crossings.
/// @param bearing  of the lines [rad].
/// @param spacing  largest distance of neighbouring lines [m], above 0.
/// @param joined   gaps in a band up to this length [m] are flown through.
/// Cost: quadratic in the corners.
std::vector<SweepLine> sweep_lines(const geo::Region& area, double bearing,
                                   double spacing, CellRule rule, double joined);

/// Extent of the area across a bearing [m].
double width_across(const geo::Region& area, double bearing);

}  // namespace skein::solve
