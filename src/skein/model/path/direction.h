// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "skein/geo/vec.h"

namespace skein::model {

/// `value` rounded to the nearest whole number, for |value| below 2^51, with two sums.
constexpr double nearest_whole(double value) {
  constexpr double kShift = 0x1.8p52;
  return (value + kShift) - kShift;
}

/// The angle of (x, y) in [-pi, pi], 0 for (0, 0): as atan2(y, x), within 5e-16 rad.
///
/// It takes the same branch of the code wherever the point lies. Where one unlike case
/// follows the other, atan2 mostly waits for branches that were guessed wrong.
///
///   atan t = atan c + atan u,  u = (t - c) / (1 + t c),  c = k / 8 next to t <= 1
///
/// and the series of atan u for |u| <= 1/16.
/// Valid:  finite coordinates of which neither 8 times nor an eighth leaves the range of
///         normal numbers.
inline double direction(double x, double y) {
  // atan(k / 8)
  static constexpr std::array<double, 9> kAtan = {0,
                                                  0.12435499454676144,
                                                  0.24497866312686414,
                                                  0.35877067027057225,
                                                  0.4636476090008061,
                                                  0.5585993153435624,
                                                  0.6435011087932844,
                                                  0.7188299996216245,
                                                  0.7853981633974483};
  const double ax = std::abs(x), ay = std::abs(y);
  const double large = ax > ay ? ax : ay, small = ax > ay ? ay : ax;
  if (!(large > 0)) [[unlikely]]
    return 0;
  const double eighths = nearest_whole(8 * (small / large));
  const double c = eighths / 8;
  const double u = (small - c * large) / (large + c * small);
  const double z = u * u, z2 = z * z;
  const double tail = ((-1.0 / 3 + z * (1.0 / 5)) + z2 * (-1.0 / 7 + z * (1.0 / 9))) +
                      z2 * z2 * (-1.0 / 11 + z * (1.0 / 13));
  const double flat = kAtan[static_cast<std::size_t>(eighths)] + (u + u * z * tail);
  const double right = ay > ax ? geo::kPi / 2 - flat : flat;
  return std::copysign(x < 0 ? geo::kPi - right : right, y);
}

}  // namespace skein::model
