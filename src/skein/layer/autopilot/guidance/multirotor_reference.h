// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/geo/vec.h"

namespace skein::autopilot {

// What the parts of MultirotorGuidance share.

inline constexpr double kVelocityGain = 4;  // of the reference [1/s]
inline constexpr double kCreep = 0.2;       // through sharp corners [m/s]
inline constexpr double kMinPace = 1;       // over ground, against the wind [m/s]

/// `v`, no longer than `max`.
inline Vec2 bounded(const Vec2& v, double max) {
  const double size = v.norm();
  return size > max ? Vec2(v * (max / size)) : v;
}

}  // namespace skein::autopilot
