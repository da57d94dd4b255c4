// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/data/vehicle/vehicle.h"

namespace skein::reasoning {

/// The straight on which an aircraft that is in a turn rolls its wings level: a plan that
/// began with the opposite turn at once would be left at once.
/// @param nav     where it believes to be; heading, roll and wind count.
/// @param limits  what it can do; nothing for one that hovers.
/// @param from    where it begins, and when [s].
/// @returns       none when its wings are all but level.
std::optional<FlightElement> level_out(const NavEstimate& nav, const FlightLimits& limits,
                                       const FlightState& from, double time);

/// Where an aircraft is with its wings level when it goes on with its present turn for a
/// while first: until an order reaches it, for example.
/// @param delay  [s].
FlightState state_when_level(const NavEstimate& nav, const FlightLimits& limits,
                             double delay);

}  // namespace skein::reasoning
