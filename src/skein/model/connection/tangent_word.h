// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/model/connection/words.h"

namespace skein::model::words {

// Slopes and bounds are met up to this share.
inline constexpr double kRounding = 1e-9;
// Circles this near to touching may touch (squared distance, radii).
inline constexpr double kTouch = 1e-12;

/// A positive turn, then the straight that touches its circle and is a tangent of what it
/// leads to: a negative turn's circle, or a point. With `way` from the first turn's
/// centre to that circle's centre, or to the point, at time 0,
///
///   way - wind T = s u + reach (sin h, -cos h),   u = (cos h, sin h)
struct TangentWord {
  Vec2 offset = Vec2::Zero();
  Vec2 wind = Vec2::Zero();
  double wind2 = 0;
  double reach = 2;  ///< 2: to another turn's circle; 1: to a point
  int turns = 2;     ///< 2: the last turn counts, to heading phi; 1: there is none
  double phi = 0;
};

/// The earliest meeting from `min` on and before `best`; docs/connection.md.
/// @param min  a time before which there is none.
Meeting earliest_meeting(const TangentWord& word, double min, double best);

/// The straight flown after turns: the s >= 0 with s^2 = |d - wind s|^2 - gap; 0 when d
/// is within the gap.
/// @param a  1 - wind^2.
double straight_after(const Vec2& d, const Vec2& wind, double a, double gap);

}  // namespace skein::model::words
