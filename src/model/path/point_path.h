#pragma once

#include "data/path.h"
#include "model/path/pose.h"

namespace skein::model {

/// Length [m] of the shortest path of bounded curvature to a point, with any course
/// there: turn and straight, or turn and opposite turn when the point lies inside a
/// turning circle.
///
/// @param radius  smallest turn radius [m], above 0.
/// Cost:      no allocation.
/// Reference: derivation in docs/aircraft.md.
double length_to_point(const Pose& from, const Vec2& point, double radius);

/// The path that length_to_point measures; empty when already there.
Path path_to_point(const Pose& from, const Vec2& point, double radius);

/// Time to reach a ground point in a steady wind at constant airspeed.
///
/// In the air mass the point moves with -wind. The result is the earliest
///
///   T >= 0 with L(point - wind T) <= airspeed T,   L = length_to_point
///
/// to 1e-6 s. L jumps where the moving point enters or leaves a turning circle; the time
/// axis is cut there. Outside the circles no root is missed; inside, two roots within a
/// 64th of the point's way through the circle may be. Where L jumps down below airspeed
/// T, the moment of the jump is returned.
///
/// @param from    position over ground and *heading* (of the air-relative velocity).
/// @param radius  smallest turn radius in the air mass [m].
/// @param wind    velocity of the air over ground [m/s].
/// @returns       [s]; infinite when |wind| >= airspeed.
/// Cost:          no allocation.
double time_to_point(const Pose& from, const Vec2& point, double airspeed, double radius,
                     const Vec2& wind);

}  // namespace skein::model
