// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/layer/reasoning/trajectory/flight_context.h"
#include "skein/layer/reasoning/trajectory/flight_intent.h"

namespace skein::reasoning {

/// A flight that is expected, not planned.
struct ExpectedFlight {
  FlightPlan plan;
  std::vector<double> points;  ///< when it passes points of legs [s]
  /// When it begins to circle the last point of legs [s]; none: not in this flight.
  std::optional<double> stays_from = {};
};

/// Where an aircraft will fly that has no plan, as far as that can be said: what others
/// have to count with.
///
/// - Steering: a turn to its course, then straight on.
/// - Circling: to the circle, then around.
/// - Legs: from point to point, then around the last.
/// - Landing: to the place; where the approach is known, to where that begins, and along
///   it, at its height from the start on. Returning: straight on.
///
/// Altitudes are reached as quickly as the aircraft climbs and sinks.
///
/// @param passed    points of legs that have been passed.
/// @param duration  of the flight at least, where it does not end before [s].
ExpectedFlight expected_flight(const FlightIntent& intent, std::size_t passed,
                               const NavEstimate& nav, const FlightContext& context,
                               double now, double duration);

/// The flight with the altitudes at which it is flown so high above the ground.
/// @param height  above the ground [m].
/// @param down    p_N.z() of the aircraft at the start [m].
FlightPlan at_height_over_ground(const FlightPlan& plan, const FlightContext& context,
                                 double height, double down);

}  // namespace skein::reasoning
