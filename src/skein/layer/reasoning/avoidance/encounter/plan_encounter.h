// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/data/traffic/separation.h"
#include "skein/data/vehicle/flight_plan.h"

namespace skein::reasoning {

/// When two flights are not apart.
struct PlanEncounter {
  double begin = 0;         ///< when they come nearer than the separation [s]
  double end = 0;           ///< when they are apart again, or where the look ends [s]
  double min_ratio = 1;     ///< least Separation::ratio until then
  double closest_time = 0;  ///< when it is least [s]
};

/// The first time that two planned flights are not apart, by where both are at the same
/// moment. It looks at the time that both plans cover, from `from` to `until` [s] of the
/// run's clock.
///
/// Where both fly straight, by closed form; else in pieces whose chords are off by at
/// most 3 cm each, so distances are within 6 cm. What it finds is an encounter of the
/// chords: flights that pass with 6 cm more than the separation are none.
///
/// Cost: linear in the elements of that time.
std::optional<PlanEncounter> first_encounter(const FlightPlan& a, const FlightPlan& b,
                                             const Separation& separation, double from,
                                             double until);

}  // namespace skein::reasoning
