// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/manoeuvre/said_limits.h"

#include <cmath>

namespace skein::reasoning {

FlownLimits said_limits(const FlightLimits& limits) {
  FlownLimits said;
  said.airspeed = static_cast<float>(limits.airspeed);
  said.turn_radius = static_cast<float>(limits.turn_radius);
  said.slowest = static_cast<float>(limits.slowest);
  said.fastest = static_cast<float>(limits.fastest);
  said.climb = static_cast<float>(limits.climb_rate);
  said.sink = static_cast<float>(limits.sink_rate);
  said.acceleration = static_cast<float>(limits.climb_acceleration);
  return said;
}

FlightLimits limits_of(const FlownLimits& said) {
  FlightLimits limits;
  limits.airspeed = said.airspeed;
  limits.turn_radius = said.turn_radius;
  limits.slowest = said.slowest;
  limits.fastest = said.fastest;
  limits.climb_rate = said.climb;
  limits.sink_rate = said.sink;
  limits.climb_acceleration = said.acceleration;
  return limits;
}

bool are_possible(const FlownLimits& said) {
  const auto positive = [](float value) { return value > 0 && std::isfinite(value); };
  const auto none_or_more = [](float value) {
    return value >= 0 && std::isfinite(value);
  };
  return positive(said.airspeed) && positive(said.turn_radius) &&
         none_or_more(said.slowest) && positive(said.fastest) &&
         none_or_more(said.climb) && none_or_more(said.sink) &&
         none_or_more(said.acceleration);
}

}  // namespace skein::reasoning
