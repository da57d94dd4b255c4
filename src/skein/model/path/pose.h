// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/geo/vec.h"

namespace skein::model {

/// A position and a direction of motion in the plane.
struct Pose {
  Vec2 position = Vec2::Zero();  ///< [m]
  double course = 0;             ///< [rad], clockwise from north
};

}  // namespace skein::model
