// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/data/traffic/separation.h"
#include "skein/data/vehicle/flight_plan.h"

namespace skein::reasoning {

/// A circle that somebody flies around until further notice.
struct HeldCircle {
  Vec2 centre = Vec2::Zero();  ///< [m]
  double radius = 0;           ///< of a circle around all that is flown [m]
  double down = 0;             ///< p_N.z() [m]
  Separation separation;       ///< to be kept to who flies it
};

/// The circle that a plan ends with: its last full turn, if all of that is turned one way
/// and is level.
///
/// Plans are known for one or two minutes; who circles at their end goes on with it. Two
/// circles that are apart stay so, whoever is where on them.
///
/// @returns  nothing where the plan ends otherwise.
std::optional<HeldCircle> circle_at_end(const FlightPlan& plan);

/// Whether two circles are apart wherever on them both are.
/// @param kept  between the two.
bool are_apart(const HeldCircle& a, const HeldCircle& b, const Separation& kept);

}  // namespace skein::reasoning
