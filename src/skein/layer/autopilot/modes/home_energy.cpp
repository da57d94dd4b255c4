// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/modes/home_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein::autopilot {
namespace {

// Closer than this there is no distance to go [m].
constexpr double kAtHome = 1e-3;

}  // namespace

double ground_speed_along(const Vec2& direction, double airspeed, const Vec2& wind) {
  const double across = geo::cross(direction, wind);
  const double square = airspeed * airspeed - across * across;
  if (square <= 0) return 0;
  return std::max(0.0, direction.dot(wind) + std::sqrt(square));
}

HomeNeed home_need(const Vec2& to_home, double height, const Vec2& wind,
                   const HomeFlight& flight) {
  const double distance = to_home.norm();
  double flight_time = 0;
  if (distance > kAtHome) {
    const double speed = ground_speed_along(to_home / distance, flight.airspeed, wind);
    flight_time = speed > 0 ? distance / speed : std::numeric_limits<double>::infinity();
  }
  const bool sinks = height > 0;
  const double vertical = sinks ? height / flight.sink_rate : -height / flight.climb_rate;
  const double level = flight_time + flight.landing_time;
  // Without this a level flight that costs nothing would be 0 times infinity.
  const double energy_level = flight.power_level > 0 ? flight.power_level * level : 0;
  return {level + vertical,
          energy_level + vertical * (sinks ? flight.power_sink : flight.power_climb)};
}

}  // namespace skein::autopilot
