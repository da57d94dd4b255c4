// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/path.h"
#include "skein/model/path/pose.h"

namespace skein::model {

/// Length [m] of the shortest path of bounded curvature to a point, with any course
/// there: turn and straight, or turn and opposite turn when the point lies inside a
/// turning circle.
///
/// @param radius  smallest turn radius [m], above 0.
/// Cost:      no allocation.
/// Reference: derivation in docs/aircraft.md.
double length_to_point(const Pose& from, const Vec2& point, double radius);

/// The same path as two parts: a turn, then a straight or an opposite turn.
struct PointPath {
  bool right = true;             ///< the first turn
  bool straight = true;          ///< the second part
  double first = 0, second = 0;  ///< turned angles [rad]; the straight in turn radii
};
PointPath shortest_to_point(const Pose& from, const Vec2& point, double radius);

/// The path that length_to_point measures; empty when already there.
Path path_to_point(const Pose& from, const Vec2& point, double radius);

}  // namespace skein::model
