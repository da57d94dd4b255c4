// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/time.h"
#include "skein/geo/vec.h"

namespace skein {

/// Where a plan wants the vehicle at one time.
struct PlanPoint {
  Time time;
  Vec3 p_N = Vec3::Zero();  ///< [m]
  Vec3 v_N = Vec3::Zero();  ///< velocity over ground [m/s]
};

/// A flight in space and time: points with growing times, joined by cubic Hermite curves
/// (position and velocity are continuous).
using Plan = std::vector<PlanPoint>;

}  // namespace skein
