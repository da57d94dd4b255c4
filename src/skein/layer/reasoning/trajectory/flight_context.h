// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "skein/base/id.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/role/path_planner.h"
#include "skein/role/terrain.h"

namespace skein::reasoning {

/// What everything on board that plans flights may count on.
struct FlightContext {
  EntityId self;
  FlightLimits limits;
  const Terrain* map = nullptr;  ///< the ground as believed; outlives who has this
  std::shared_ptr<const PathPlanner> planner;  ///< of paths around zones; null: none
  double altitude_agl = 120;                   ///< to be flown above the ground [m]
  /// As last ordered [m/s]; none: the autopilot's own. `limits` have it too.
  std::optional<double> ordered_airspeed = {};
};

/// What plans are made with: wider turns than the aircraft can fly, wider still for one
/// that hovers, as it does not know the wind that it has to tilt against.
/// @param radius_factor  over the minimum turn radius, room to correct.
inline FlightLimits planning_limits(const FlightLimits& limits, double radius_factor) {
  constexpr double kHovering = 2;
  FlightLimits wider = limits;
  wider.turn_radius *= radius_factor * (limits.slowest > 0 ? 1 : kHovering);
  return wider;
}

}  // namespace skein::reasoning
