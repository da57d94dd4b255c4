// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "skein/layer/autopilot/guidance/fixed_wing_guidance.h"

namespace skein::autopilot {

// What the parts of FixedWingGuidance that follow a line share.

inline constexpr double kFlares = 1;  // lateral acceleration close to the ground [m/s^2]
inline constexpr double kMinSpeed = 1;  // over ground, for windows of time [m/s]

inline GroundMotion over_ground(const FixedWingMotion& now) {
  return {now.p_N.head<2>(), now.v_N.head<2>(), now.lateral_acceleration};
}

// The law in use, on a line whose nearest point to the motion ahead is known.
template <class Line>
double lateral(const LateralOptions& options, const Sight& sight, const Line& line,
               const model::TrackPoint& nearest, double cross_track,
               const GroundMotion& ahead) {
  if (options.law == LateralLaw::kCourse)
    return course_law(nearest, cross_track, ahead.velocity, options.course);
  return sight_law(sight, line, nearest, cross_track, ahead);
}

// A path or curve near the vehicle's place, moved on to where it will be `ahead`.
inline double moved(const model::TrackPoint& at, double cross_track, const Vec2& by) {
  return by.dot(at.tangent) / std::max(1 - at.curvature * cross_track, 0.2);
}
inline double off_track(const model::TrackPoint& at, const Vec2& p) {
  return geo::cross(at.tangent, p - at.position);
}

}  // namespace skein::autopilot
