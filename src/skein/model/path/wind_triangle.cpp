// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/wind_triangle.h"

#include <cmath>

#include "skein/base/math.h"

namespace skein::model {

std::optional<double> heading_for_course(double course, double airspeed,
                                         const Vec2& wind) {
  const Vec2 along = geo::unit(course);
  const double right = geo::cross(along, wind);
  if (std::abs(right) >= airspeed) return std::nullopt;
  const double ground_speed =
      std::sqrt(airspeed * airspeed - right * right) + wind.dot(along);
  if (ground_speed <= 0) return std::nullopt;
  return geo::wrap_pi(course - math::asin(right / airspeed));
}

double ground_turn_radius(double radius, double airspeed, double wind_speed) {
  const double stretch = 1 + wind_speed / airspeed;
  return radius * stretch * stretch;
}

}  // namespace skein::model
