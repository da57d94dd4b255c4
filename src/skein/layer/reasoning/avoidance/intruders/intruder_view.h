// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "skein/data/airspace/airspace.h"
#include "skein/layer/reasoning/avoidance/intruders/intruder.h"
#include "skein/role/path_planner.h"

namespace skein::reasoning {

/// What is to be kept out of the way of, at one step.
struct IntruderView {
  double now = 0;           ///< [s]
  Vec3 p_N = Vec3::Zero();  ///< of the own aircraft [m]
  Vec3 v_N = Vec3::Zero();  ///< over ground [m/s]
  const FlightPlan& plan;   ///< that is flown
  double rejoins = 0;       ///< where that must be met again [s]
  std::span<const AvoidedIntruder> intruders;
  const PathQuery& query;                ///< limits, wind, ground
  std::span<const Zone> zones;           ///< no-fly
  std::span<const PlannedFlight> rooms;  ///< of planned flights of the team
  IntruderRoom kind = IntruderRoom::kMoving;
};

}  // namespace skein::reasoning
