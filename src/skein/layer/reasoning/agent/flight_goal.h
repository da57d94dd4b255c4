// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/vehicle.h"
#include "skein/layer/reasoning/trajectory/flight_intent.h"
#include "skein/model/well_clear/band_advisor.h"

namespace skein::reasoning {

/// What an aircraft would do if nobody were in its way: bands and recovery are looked for
/// from there.
///
///   a plan   to where it leads a minute later, at the speed flown
///   legs     to the point that is next
///   a course that one
///   circles, landings  to their place, if that is not near
///   returns  straight on
///
/// @param wanted  by the task; null: straight on.
/// @param passed  points of legs that have been passed.
/// @param now     [s].
model::FlightGoal goal_of(const FlightIntent* wanted, std::size_t passed,
                          const NavEstimate& nav, double now);

}  // namespace skein::reasoning
