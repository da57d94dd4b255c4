#pragma once

#include <memory>

#include "skein/base/id.h"
#include "skein/data/vehicle.h"
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
};

}  // namespace skein::reasoning
