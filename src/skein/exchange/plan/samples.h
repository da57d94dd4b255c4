// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/model/path/flight_plan.h"

namespace skein::exchange {

/// A moment of a plan and the element it belongs to.
struct FlightSample {
  std::size_t element = 0;
  double time = 0;  ///< on the run's clock [s]
  model::FlightMoment moment;
};

/// Moments of a plan, so close that straight legs flown evenly between them leave it by
/// at most `tolerance`. The second derivative of an element's motion is V |r| for
/// airspeed V and turn rate r, whatever the wind, so with steps of h seconds
///
///   distance <= V |r| h^2 / 8
///
/// Both ends of every element are among them; where elements join, the end of the first
/// is left out.
///
/// @param tolerance  [m], above 0.
/// @param longest    step [s], above 0.
/// Cost: one sample per sqrt(8 tolerance / (V |r|)) seconds of turn.
std::vector<FlightSample> samples(const FlightPlan& plan, double tolerance,
                                  double longest = 1e300);

/// As above for one element, its end included.
std::vector<FlightSample> samples(const FlightElement& element, double tolerance,
                                  double longest = 1e300);

/// "left turn", "right turn", "straight", or without a turn to a side "vertical turn up"
/// or "vertical turn down".
const char* kind_of(const FlightElement& element);

}  // namespace skein::exchange
