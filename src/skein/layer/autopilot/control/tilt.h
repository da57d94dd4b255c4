// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/geo/rotation.h"

namespace skein::autopilot {

/// Attitude to the horizon, without the heading.
struct Tilt {
  explicit Tilt(const Quat& q_NB) {
    const Vec3 down = geo::down_in_body(q_NB);
    sin_pitch = std::clamp(-down.x(), -1.0, 1.0);
    cos_pitch = std::max(0.05, std::sqrt(down.y() * down.y() + down.z() * down.z()));
    sin_roll = std::clamp(down.y() / cos_pitch, -1.0, 1.0);
    cos_roll = std::clamp(down.z() / cos_pitch, -1.0, 1.0);
    roll = math::atan2(down.y(), down.z());
    pitch = math::asin(sin_pitch);
  }

  /// Load factor of a level turn with this bank, up to 70 degrees.
  double load() const { return 1 / std::max(cos_roll, 0.34); }

  double sin_pitch, cos_pitch;  // cos_pitch kept away from 0
  double sin_roll, cos_roll;
  double roll, pitch;  // [rad]
};

}  // namespace skein::autopilot
