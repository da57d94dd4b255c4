// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "skein/layer/reasoning/avoidance/intruders/intruder.h"
#include "skein/role/path_planner.h"

namespace skein::reasoning {

/// What is flown where no course leads out of the way of intruders any more.
struct Escape {
  double course = 0;  ///< over ground [rad]
  bool up = true;     ///< it climbs, else it sinks
};

/// The course on which the intruders pass farthest away, and up where the one that comes
/// nearest will be below, down where it will be above.
///
/// Courses are looked at every 15 degrees, turned to with the turn radius of the limits,
/// at the speed that is flown, for half a minute. Intruders go straight on.
///
/// @param p_N, v_N  of the own aircraft [m], over ground [m/s].
/// @param intruders at least one.
/// Cost: 1,500 distances for each intruder; no allocation.
/// Reference: spec/team.md section 3, the last row.
Escape escape_from(const Vec3& p_N, const Vec3& v_N, const FlightLimits& limits,
                   std::span<const AvoidedIntruder> intruders, double now);

}  // namespace skein::reasoning
