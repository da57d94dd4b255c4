#pragma once

#include <string>
#include <vector>

#include "base/time.h"
#include "scenario/scenario.h"

namespace skein::assemble {

/// The step of plants that take actuators, where the scenario does not say.
inline const Time kFlightStep = Time::from_ns(10'000'000);

/// How often the true fire moves: as the scenario says, else the longest period that
/// divides one second, the metrics' period and the time between two looks of every
/// sensor at the fire, so that none of them sees a fire of the past.
Time truth_period(const scenario::Scenario& scenario);

/// What cannot be sampled as the scenario wants it, one line each: sensors with more
/// samples than steps, and sensors that look at the fire more often than it moves.
std::vector<std::string> sampling_warnings(const scenario::Scenario& scenario);

}  // namespace skein::assemble
