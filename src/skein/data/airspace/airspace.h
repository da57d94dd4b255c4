// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "skein/base/id.h"
#include "skein/data/airspace/zone.h"
#include "skein/data/vehicle/flight_plan.h"
#include "skein/data/vehicle/safety_zone.h"

namespace skein {

/// An obstacle that moves evenly: a balloon, a crane's load, traffic that has reported
/// nothing but where it is and how it moves. An upright cylinder.
struct MovingObstacle {
  double time = 0;          ///< at which it is at `p_N` [s]
  Vec3 p_N = Vec3::Zero();  ///< its middle then [m]
  Vec3 v_N = Vec3::Zero();  ///< [m/s]
  double radius = 50;       ///< to be kept from it sideways [m]
  double height = 30;       ///< to be kept from it up and down [m]
  double from = -std::numeric_limits<double>::infinity();  ///< there since [s]
  double until = std::numeric_limits<double>::infinity();  ///< there until [s]
};

/// Where another aircraft has planned to fly, and the room that its plan owns: at time t
/// everything within `zone.across` of where the plan is between t - behind and t + ahead,
/// and within `height` of its altitude.
struct PlannedFlight {
  EntityId who;
  FlightPlan plan;
  SafetyZone zone;
  double height = 20;  ///< up and down [m]
};

/// All that a flight path has to keep out of, but for the ground, which is a Terrain.
struct Airspace {
  std::vector<Zone> zones;
  std::vector<MovingObstacle> movers;
  std::vector<PlannedFlight> flights;
};

}  // namespace skein
