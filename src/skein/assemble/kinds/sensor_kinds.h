// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/assemble/kinds/kinds_of.h"

// Sensors by subject: each adds its rows to the table of kinds.

namespace skein::assemble {

void add_simple_sensors(Kinds<Sensor, AircraftContext>& kinds);
void add_flight_sensors(Kinds<Sensor, AircraftContext>& kinds);
void add_payload_sensors(Kinds<Sensor, AircraftContext>& kinds);
void add_traffic_sensors(Kinds<Sensor, AircraftContext>& kinds);

/// The oldest that the position of a sensor gets before the next one comes [s]: its
/// period, not below `step`, and its latency. None for a sensor that gives no position.
std::optional<double> position_age(const scenario::Choice& sensor, double step);

// Ranges of keys that many have.
inline constexpr scenario::Range kSensorRate{.above = 0, .at_most = 1000};
inline constexpr scenario::Range kSensorError{.at_least = 0, .at_most = 1e6};
inline constexpr scenario::Range kProbability{.at_least = 0, .at_most = 1};

/// Rate and latency, which every sensor with errors of its own has.
template <class T>
scenario::Fields<T> sampled() {
  return scenario::Fields<T>()
      .number("rate_hz", &T::rate_hz, "Samples per second.", kSensorRate)
      .duration_s("latency_s", &T::latency, "From measuring to arriving.",
                  {.at_least = 0, .at_most = 5});
}

}  // namespace skein::assemble
