// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/flight_plan.h"
#include "skein/data/vehicle/vehicle.h"

namespace skein::solve {

/// Gives a level plan an altitude that begins at `from_down` and changes as fast as it
/// may until it is `to_down` (values of p_N.z() [m]); the horizontal motion stays.
/// Elements are divided where the climb rate changes.
/// @returns  false when the plan ends before.
bool climb_along(FlightPlan& plan, double from_down, double to_down,
                 const FlightLimits& limits);

}  // namespace skein::solve
