// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/scenario/kind_table.h"
#include "skein/scenario/scenario.h"

namespace skein::assemble {

/// The step of plants that take actuators, where the scenario does not say.
inline constexpr Time kFlightStep = Time::from_ns(10'000'000);

/// The step of sensors, autopilot and plant of a group: as the scenario says, else the
/// run's, for plants that take actuators at most 10 ms.
/// Fails: kBadInput when 10 ms do not divide the run's step.
Result<Time> flight_step(const scenario::Scenario& scenario,
                         const scenario::AircraftGroup& group);

/// How often the true fire moves: as the scenario says, else the longest period that
/// divides one second, the metrics' period and the time between two looks of every
/// sensor at the fire, so that none of them sees a fire of the past.
Time truth_period(const scenario::Scenario& scenario, const scenario::KindTable& kinds);

/// What cannot be sampled as the scenario wants it, one line each: sensors with more
/// samples than steps, and sensors that look at the fire more often than it moves.
std::vector<std::string> sampling_warnings(const scenario::Scenario& scenario,
                                           const scenario::KindTable& kinds);

}  // namespace skein::assemble
