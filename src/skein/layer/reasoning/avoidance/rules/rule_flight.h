// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "skein/layer/reasoning/avoidance/manoeuvre/manoeuvred_flight.h"
#include "skein/layer/reasoning/avoidance/rules/right_of_way.h"

namespace skein::reasoning {

/// The flight that a rule asks for: the quickest of the manoeuvres that it allows, of
/// 0.4, 0.7, 1, 1.7 and 3 times the separation, that is apart from the other's plan.
///
/// - Head-on, overtaking, the other from the right or unable: passes to the right; where
///   that takes more than 15 s longer, flies slower.
/// - Climbing through: stays below or above until the other has passed.
/// - Closing slowly: other airspeeds first.
///
/// Where none of these is apart, anything that is.
///
/// @param whole     makes the whole flight of one with the manoeuvre; none: not possible.
/// @param is_apart  from the other, and free of zones and ground.
/// @returns  none where nothing is.
std::optional<FlightPlan> flight_by_rule(
    AirRule rule, const ConflictOfFlight& conflict,
    const std::function<std::optional<FlightPlan>(const Manoeuvre&)>& whole,
    const std::function<bool(const FlightPlan&)>& is_apart);

}  // namespace skein::reasoning
