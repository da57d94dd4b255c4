// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <numbers>

#include "skein/base/math.h"

namespace skein {

/// A point or vector in the local horizontal plane: x = north [m], y = east [m].
using Vec2 = Eigen::Vector2d;
/// A point or vector in the local frame N: north, east, down [m].
using Vec3 = Eigen::Vector3d;

namespace geo {

inline constexpr double kPi = std::numbers::pi;

constexpr double radians(double degrees) {
  return degrees * (kPi / 180);
}
constexpr double degrees(double radians) {
  return radians * (180 / kPi);
}

/// The angle in (-pi, pi] that differs from `angle` [rad] by whole turns.
inline double wrap_pi(double angle) {
  const double wrapped = std::remainder(angle, 2 * kPi);
  return wrapped == -kPi ? kPi : wrapped;
}

/// The angle in [0, 2 pi) that differs from `angle` [rad] by whole turns.
inline double wrap_2pi(double angle) {
  const double wrapped = std::fmod(angle, 2 * kPi);
  const double positive = wrapped < 0 ? wrapped + 2 * kPi : wrapped;
  return positive >= 2 * kPi ? 0.0 : positive;
}

/// The unit vector that points to `bearing` [rad, clockwise from north].
inline Vec2 unit(double bearing) {
  return {math::cos(bearing), math::sin(bearing)};
}

/// The bearing [rad, clockwise from north, (-pi, pi]] of `v`.
inline double bearing(const Vec2& v) {
  return math::atan2(v.y(), v.x());
}

/// a.north b.east - a.east b.north: positive when b lies clockwise of a (on the map).
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// `v` turned a quarter clockwise (on the map): north becomes east.
inline Vec2 turned_right(const Vec2& v) {
  return {-v.y(), v.x()};
}
/// `v` turned a quarter counter-clockwise (on the map): north becomes west.
inline Vec2 turned_left(const Vec2& v) {
  return {v.y(), -v.x()};
}

/// The horizontal part of a vector in N.
inline Vec2 horizontal(const Vec3& v) {
  return v.head<2>();
}

}  // namespace geo
}  // namespace skein
