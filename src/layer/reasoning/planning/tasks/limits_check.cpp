#include "layer/reasoning/planning/tasks/limits_check.h"

#include <fmt/format.h>

#include <cmath>

namespace skein::planning {

std::string limits_fault(const FlightLimits& limits) {
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  if (!positive(limits.airspeed))
    return fmt::format("airspeed {} m/s must be above 0", limits.airspeed);
  if (!positive(limits.turn_radius))
    return fmt::format("turn radius {} m must be above 0", limits.turn_radius);
  if (!(std::isfinite(limits.climb_rate) && limits.climb_rate >= 0) ||
      !(std::isfinite(limits.sink_rate) && limits.sink_rate >= 0))
    return "climb and sink rate must be at least 0";
  return {};
}

std::string speeds_fault(const FlightLimits& limits) {
  if (limits.slowest >= 0 && limits.slowest <= limits.airspeed &&
      limits.airspeed <= limits.fastest && std::isfinite(limits.fastest))
    return {};
  return fmt::format(
      "airspeed {} m/s must lie between the slowest, {}, and the fastest, {}",
      limits.airspeed, limits.slowest, limits.fastest);
}

std::string too_strong(double wind, double airspeed) {
  return fmt::format(
      "wind of {:.1f} m/s is not below the airspeed of {:.1f} m/s: places upwind cannot "
      "be "
      "reached",
      wind, airspeed);
}

}  // namespace skein::planning
