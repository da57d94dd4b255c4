// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/flight_plan.h"
#include "skein/data/vehicle/plan.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/role/terrain.h"

namespace skein::reasoning {

/// A plan sampled for an autopilot, at altitudes so high above the ground ahead as
/// altitude_over() has them, reached from the present altitude as quickly as the aircraft
/// climbs and sinks.
///
/// @param height  above the ground [m].
/// @param down    p_N.z() of the aircraft at the plan's start [m].
Plan drape(const FlightPlan& plan, const Terrain& ground, double height,
           const FlightLimits& limits, double down);

}  // namespace skein::reasoning
