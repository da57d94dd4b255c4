// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/geo/vec.h"

namespace skein::solve {

/// How fast an aircraft is over ground along a course, in a constant wind:
///
///   v(c) = w_along + sqrt(V^2 - w_across^2)
class GroundSpeed {
 public:
  /// @param airspeed  [m/s], above the wind's.
  GroundSpeed(double airspeed, const Vec2& wind);

  double along(const Vec2& unit) const;
  /// Time of a straight path [s].
  double straight(const Vec2& leg) const;
  /// Time of an arc over ground [s], from a course on.
  /// @param turned  by how much the course changes [rad], positive right.
  double arc(double radius, double course, double turned) const;
  double slowest() const { return airspeed_ - wind_.norm(); }

 private:
  // Integral of 1 / v over the course, from 0 to `course`.
  double slowness(double course) const;

  double airspeed_;
  Vec2 wind_;
  std::vector<double> table_;  // empty without wind
};

}  // namespace skein::solve
