// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "skein/layer/reasoning/avoidance/manoeuvre/candidates.h"

namespace skein::reasoning {

/// A flight that puts off the next meeting with others.
struct EvasiveFlight {
  FlightPlan flight;
  double meets = 0;  ///< the first meeting with another flight; infinity: none [s]
};

/// Of the manoeuvres that an aircraft can fly at once (candidates() of the strengths 1
/// and 1.7, and turns of 20 to 130 degrees to either side), the one that meets others
/// last: of those that meet nobody within a minute the cheapest. For when no flight
/// without a meeting has been found in time.
///
/// @param conflict   what the flight meets; the flight goes to the end of its plan.
/// @param others     all flights to be kept apart from.
/// @param is_free    whether zones and ground leave a flight free.
/// @returns  none where nothing is free of zones and ground and meets others at least two
///           seconds later than the plan.
/// Cost: some hundred flights are compared with those of the others that may be met.
std::optional<EvasiveFlight> evasive_flight(
    const ConflictOfFlight& conflict, std::span<const KnownFlight> others,
    const std::function<bool(const FlightPlan&)>& is_free);

}  // namespace skein::reasoning
