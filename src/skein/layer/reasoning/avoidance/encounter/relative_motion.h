// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/data/traffic/separation.h"
#include "skein/geo/vec.h"

namespace skein::reasoning {

/// Where one aircraft is, seen from another, while both move evenly.
struct RelativeMotion {
  Vec3 p_N = Vec3::Zero();  ///< at the begin [m]
  Vec3 v_N = Vec3::Zero();  ///< [m/s]
};

/// A part of a motion: seconds after its begin.
struct MotionSpan {
  double begin = 0, end = 0;
};

/// When the motion is within the separation, of the first `duration` seconds; none where
/// it never is. The cylinder is convex, so it is one span.
std::optional<MotionSpan> time_within(const RelativeMotion& motion, double duration,
                                      const Separation& separation);

/// How near the motion comes within a span.
struct Closest {
  double ratio = 0;  ///< Separation::ratio
  double after = 0;  ///< seconds after the motion's begin
};
Closest closest(const RelativeMotion& motion, const MotionSpan& span,
                const Separation& separation);

}  // namespace skein::reasoning
