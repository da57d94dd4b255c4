// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/ground_speed.h"

#include <algorithm>
#include <cmath>

namespace skein::solve {
namespace {

constexpr std::size_t kSteps = 720;
constexpr double kStep = 2 * geo::kPi / static_cast<double>(kSteps);

// The cubic with the given values and slopes at both ends of a step, at a part of it.
double cubic(double begin, double end, double slope_begin, double slope_end,
             double part) {
  const double rise = end - begin, bend = kStep * slope_begin - rise;
  const double other = rise - kStep * slope_end, left = 1 - part;
  return begin + part * rise + part * left * (left * bend + part * other);
}

}  // namespace

GroundSpeed::GroundSpeed(double airspeed, const Vec2& wind)
    : airspeed_(airspeed), wind_(wind) {
  if (!wind.isZero()) fill_table();
}

// Simpson's rule over each step and over its halves. What the cubic between two courses
// is off by in their middle, where that is most, and what both rules differ by, say how
// exact the table is.
void GroundSpeed::fill_table() {
  const auto slowness_at = [&](double course) { return 1 / along(geo::unit(course)); };
  table_.reserve(kSteps + 1);
  table_.push_back({0, slowness_at(0)});
  double off_between = 0, off = 0;
  for (std::size_t i = 0; i < kSteps; ++i) {
    const double c = static_cast<double>(i) * kStep;
    const double a = table_.back().here, b = slowness_at(c + kStep / 4),
                 m = slowness_at(c + kStep / 2), d = slowness_at(c + 3 * kStep / 4),
                 e = slowness_at(c + kStep);
    const double whole = kStep / 6 * (a + 4 * m + e);
    const double first = kStep / 12 * (a + 4 * b + m);
    const double halves = first + kStep / 12 * (m + 4 * d + e);
    const double better = halves + (halves - whole) / 15;
    off += std::abs(halves - whole) / 15;
    off_between = std::max(off_between, std::abs(cubic(0, better, a, e, 0.5) - first));
    table_.push_back({table_.back().integral + better, e});
  }
  arc_error_ = 2 * (off_between + off);
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
  const Slowness &from = table_[i], &to = table_[i + 1];
  return turns * table_.back().integral + cubic(from.integral, to.integral, from.here,
                                                to.here, x - static_cast<double>(i));
}

double GroundSpeed::arc(double radius, double course, double turned) const {
  if (table_.empty()) return radius * std::abs(turned) / airspeed_;
  return radius * std::abs(slowness(course + turned) - slowness(course));
}

}  // namespace skein::solve
