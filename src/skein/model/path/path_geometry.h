// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/path.h"
#include "skein/model/path/pose.h"

namespace skein::model {

/// Pose at arc length `s` [m] of a straight or arc, in closed form; `s` beyond the ends
/// continues the element.
Pose pose_at(const PathElement& element, double s);

/// Pose at the element's end.
Pose end_of(const PathElement& element);

double length(const Path& path);  ///< [m]

/// Pose at arc length `s` of a path; before its start and after its end the path goes on
/// straight. Fails: Bug when the path is empty.
Pose pose_at(const Path& path, double s);

/// Curvature [1/m] at arc length `s`; 0 outside the path.
double curvature_at(const Path& path, double s);

/// Where a position is, seen from a path.
struct PathProjection {
  double along = 0;        ///< arc length of the nearest point [m]
  double remaining = 0;    ///< from there to the path's end [m]
  double cross_track = 0;  ///< from the path across its course there [m], right positive
  double course = 0;       ///< of the path there [rad]
  double curvature = 0;    ///< of the path there [1/m]
};

/// The nearest point of a path among those whose arc length lies in [from, to].
///
/// The bounds make it possible to follow a path that crosses itself. The nearest of equal
/// points is the earliest. Beyond the ends of the path cross_track is the distance to the
/// straight line that continues it.
/// Fails: Bug when the path is empty. Cost: linear in the elements.
PathProjection project(const Path& path, const Vec2& p, double from, double to);

}  // namespace skein::model
