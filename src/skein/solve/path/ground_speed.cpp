// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/ground_speed.h"

#include <cmath>

namespace skein::solve {
namespace {

constexpr std::size_t kSteps = 720;
constexpr double kStep = 2 * geo::kPi / static_cast<double>(kSteps);

}  // namespace

GroundSpeed::GroundSpeed(double airspeed, const Vec2& wind)
    : airspeed_(airspeed), wind_(wind) {
  if (wind.isZero()) return;
  table_.assign(kSteps + 1, 0);
  // Simpson's rule: off by less than 1e-8 up to winds of 0.9 airspeeds.
  for (std::size_t i = 0; i < kSteps; ++i) {
    const double c = static_cast<double>(i) * kStep;
    table_[i + 1] =
        table_[i] + kStep / 6 *
                        (1 / along(geo::unit(c)) + 4 / along(geo::unit(c + kStep / 2)) +
                         1 / along(geo::unit(c + kStep)));
  }
}

double GroundSpeed::along(const Vec2& unit) const {
  const double across = geo::cross(unit, wind_);
  return unit.dot(wind_) + std::sqrt(airspeed_ * airspeed_ - across * across);
}

double GroundSpeed::straight(const Vec2& leg) const {
  const double length = leg.norm();
  if (length == 0) return 0;
  return table_.empty() ? length / airspeed_ : length / along(leg / length);
}

double GroundSpeed::slowness(double course) const {
  const double turns = std::floor(course / (2 * geo::kPi));
  const double x = (course - turns * 2 * geo::kPi) / kStep;
  const std::size_t i = std::min(static_cast<std::size_t>(x), kSteps - 1);
  const double part = x - static_cast<double>(i);
  return turns * table_.back() + table_[i] + part * (table_[i + 1] - table_[i]);
}

double GroundSpeed::arc(double radius, double course, double turned) const {
  if (table_.empty()) return radius * std::abs(turned) / airspeed_;
  return radius * std::abs(slowness(course + turned) - slowness(course));
}

}  // namespace skein::solve
