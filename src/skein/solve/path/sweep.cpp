// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/sweep.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "skein/base/math.h"

namespace skein::solve {
namespace {

bool cross_each_other(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Vec2 u = b - a, v = d - c;
  return geo::cross(u, c - a) * geo::cross(u, d - a) < 0 &&
         geo::cross(v, a - c) * geo::cross(v, b - c) < 0;
}

}  // namespace

Span Span::cut(const Span& other) const {
  return {std::max(begin, other.begin), std::min(end, other.end)};
}

double distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 u = b - a;
  const double length2 = u.squaredNorm();
  const double along = length2 > 0 ? std::clamp(u.dot(p - a) / length2, 0.0, 1.0) : 0.0;
  return (p - a - along * u).norm();
}

double distance(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  if (cross_each_other(a, b, c, d)) return 0;
  return std::min(
      {distance(a, c, d), distance(b, c, d), distance(c, a, b), distance(d, a, b)});
}

double distance_without_wind(const Vec2& p, const FlightElement& e, const Span& after) {
  const Vec2 a = geo::horizontal(model::position(e, after.begin));
  const Vec2 b = geo::horizontal(model::position(e, after.end));
  if (e.turn_rate == 0) return distance(p, a, b);
  const double side = e.turn_rate > 0 ? 1 : -1;
  const double radius = e.airspeed / std::abs(e.turn_rate);
  const Vec2 centre =
      geo::horizontal(e.p_N) + side * radius * geo::turned_right(geo::unit(e.heading));
  const Vec2 out = p - centre;
  // The turn passes the place nearest to p with the heading along the circle there.
  const double heading = geo::bearing(out) + side * geo::kPi / 2;
  const double begin = e.heading + e.turn_rate * after.begin;
  const double turned = std::abs(e.turn_rate) * (after.end - after.begin);
  if (geo::wrap_2pi(side * (heading - begin)) <= turned)
    return std::abs(out.norm() - radius);
  return std::min((p - a).norm(), (p - b).norm());
}

double chord_error(const FlightElement& e, double h) {
  return e.airspeed * std::abs(e.turn_rate) * h * h / 8;
}

double vertical_chord_error(const FlightElement& e, double h) {
  return std::abs(e.climb_acceleration) * h * h / 8;
}

Box box_of(const FlightElement& e) {
  const Vec3 end = model::position(e, e.duration);
  const double turned = std::abs(e.turn_rate) * e.duration;
  // In the air mass the turn leaves its chord by its sagitta, at most by its diameter.
  double out = 0;
  if (turned > 0) {
    const double radius = e.airspeed / std::abs(e.turn_rate);
    out = radius * (turned < 2 * geo::kPi ? 1 - math::cos(turned / 2) : 2);
  }
  const Vec2 drift = e.wind * e.duration;
  Box box;
  for (int i = 0; i < 2; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double a = e.p_N[i], b = end[i] - drift[i];
    box.low[k] = std::min(a, b) - out + std::min(drift[i], 0.0);
    box.high[k] = std::max(a, b) + out + std::max(drift[i], 0.0);
    if (turned == 0) {
      box.low[k] = std::min(a, end[i]);
      box.high[k] = std::max(a, end[i]);
    }
  }
  box.low[2] = -std::max(e.p_N.z(), end.z());
  box.high[2] = -std::min(e.p_N.z(), end.z());
  if (e.climb_acceleration != 0) {
    const double level = -e.climb_rate / e.climb_acceleration;  // when it is
    const double there = -model::position(e, std::clamp(level, 0.0, e.duration)).z();
    box.low[2] = std::min(box.low[2], there);
    box.high[2] = std::max(box.high[2], there);
  }
  box.low[3] = e.start;
  box.high[3] = e.start + e.duration;
  return box;
}

namespace {

// Times at which a + b t + c t^2 is 0; infinite where there are none.
std::array<double, 2> zeros(double a, double b, double c) {
  const double inner = b * b - 4 * a * c;
  if (!(inner >= 0) || !std::isfinite(inner)) return {math::kInfinity, math::kInfinity};
  const double q = -(b + std::copysign(std::sqrt(inner), b)) / 2;
  return {q / c, q != 0 ? a / q : 0.0};
}

// With a vertical acceleration: between two passages of the range's ends the element is
// either within or not.
Span within_parabola(const FlightElement& e, double low, double high, double climb) {
  const double altitude = -e.p_N.z(), half = e.climb_acceleration / 2;
  const auto from_low = zeros(altitude - low, climb, half);
  const auto from_high = zeros(altitude - high, climb, half);
  std::array<double, 6> times = {
      0, from_low[0], from_low[1], from_high[0], from_high[1], e.duration};
  for (double& t : times) t = std::clamp(t, 0.0, e.duration);
  std::sort(times.begin(), times.end());
  Span span{1, 0};
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    const double middle = (times[k] + times[k + 1]) / 2;
    const double at = altitude + (climb + half * middle) * middle;
    if (at < low || at > high) continue;
    if (span.empty()) span.begin = times[k];
    span.end = times[k + 1];
  }
  return span;
}

}  // namespace

Span within_altitudes(const FlightElement& e, double low, double high, double rate) {
  const double altitude = -e.p_N.z(), climb = e.climb_rate - rate;
  if (e.climb_acceleration != 0) return within_parabola(e, low, high, climb);
  if (climb == 0) {
    if (altitude < low || altitude > high) return {1, 0};
    return {-math::kInfinity, math::kInfinity};
  }
  const double a = (low - altitude) / climb, b = (high - altitude) / climb;
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace skein::solve
