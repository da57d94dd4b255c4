// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/limits_check.h"

#include <fmt/format.h>

#include <cmath>

#include "skein/model/path/climb_profile.h"

namespace skein::solve {

bool on_map(const Vec2& p) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= kMaxCoordinate;
}

std::string state_error(const FlightState& state) {
  // Whole turns are fine, but not so many that nothing is left of the heading.
  const bool fine = on_map(geo::horizontal(state.p_N)) &&
                    std::abs(state.p_N.z()) <= kMaxCoordinate &&
                    std::abs(state.heading) <= kMaxCoordinate;
  return fine ? "" : "it is not a place on the map with a heading";
}

bool usable_time(double time) {
  return std::abs(time) <= kMaxTime;
}

std::string limits_error(const FlightLimits& limits) {
  if (!(limits.airspeed >= 0.1 && limits.airspeed <= 1000))
    return fmt::format("airspeed {} m/s must be from 0.1 to 1000", limits.airspeed);
  if (!(limits.turn_radius >= 0.1 && limits.turn_radius <= 1e5))
    return fmt::format("turn radius {} m must be from 0.1 to 100000", limits.turn_radius);
  if (!(std::isfinite(limits.climb_rate) && limits.climb_rate >= 0) ||
      !(std::isfinite(limits.sink_rate) && limits.sink_rate >= 0))
    return "climb and sink rate must be at least 0";
  if (!(std::isfinite(limits.climb_acceleration) && limits.climb_acceleration >= 0))
    return "the climb's acceleration must be at least 0";
  return {};
}

std::string speeds_error(const FlightLimits& limits) {
  if (limits.slowest >= 0 && limits.slowest <= limits.airspeed &&
      limits.airspeed <= limits.fastest && limits.fastest <= 10 * limits.airspeed)
    return {};
  return fmt::format(
      "airspeed {} m/s must lie between the slowest, {}, and the fastest, {}",
      limits.airspeed, limits.slowest, limits.fastest);
}

std::string climb_error(double climb, const FlightLimits& limits) {
  if (std::abs(climb) < 1e-9) return {};
  const double rate = climb > 0 ? limits.climb_rate : limits.sink_rate;
  if (model::climb_time(std::abs(climb), rate, limits.climb_acceleration) <=
      kLongestFlight)
    return {};
  return fmt::format("a climb of {:.1f} m cannot be flown at {:.3g} m/s", climb, rate);
}

bool too_windy(double wind, double airspeed) {
  return !(wind < (1 - 1e-6) * airspeed);
}

std::string too_strong(double wind, double airspeed) {
  return fmt::format(
      "wind of {:.1f} m/s is not below the airspeed of {:.1f} m/s: places upwind cannot "
      "be "
      "reached",
      wind, airspeed);
}

}  // namespace skein::solve
