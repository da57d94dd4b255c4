// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/geo/vec.h"

namespace skein {

/// A straight line or circular arc over ground, flown from its start.
struct PathElement {
  Vec2 start = Vec2::Zero();  ///< [m]
  double course = 0;          ///< direction at the start [rad]
  double length = 0;          ///< along the element [m]
  double curvature = 0;       ///< [1/m]; positive turns right, 0 is straight
};

/// Elements that join with equal position and course.
using Path = std::vector<PathElement>;

}  // namespace skein
