// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/airspace/zone.h"
#include "skein/data/describe/named_value.h"
#include "skein/data/perimeter/fire.h"
#include "skein/data/team/task.h"
#include "skein/data/vehicle/vehicle.h"

namespace skein {

/// What the coordinator knows about one aircraft.
struct AircraftStatus {
  EntityId id;
  NavEstimate nav;  ///< as last reported, carried on to now
  FlightLimits limits;
  std::optional<bool> inside;  ///< its last reading
  Time last_crossing;          ///< when it last crossed the boundary; 0 = never
  bool has_crossed = false;
  Task task;               ///< its order; number 0 = none yet
  bool task_done = false;  ///< it reports that order as done
};

/// All that a monitoring strategy decides from.
struct MonitoringSituation {
  Time now;
  const BoundaryEstimate* boundary = nullptr;  ///< never null
  std::span<const AircraftStatus> aircraft;    ///< only those that can fly now
  Vec2 origin = Vec2::Zero();                  ///< believed origin of the fire [m]
  std::span<const Zone> zones;                 ///< no-fly zones
};

/// A new order for one aircraft; aircraft without one keep what they have.
struct Assignment {
  EntityId aircraft;
  TaskKind what;
  std::vector<NamedValue> why = {};  ///< the terms that have decided; empty: none
};

}  // namespace skein
