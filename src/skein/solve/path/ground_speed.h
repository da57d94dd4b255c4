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
  /// What the time of an arc may be off by, for each metre of its radius [s/m].
  double arc_error() const { return arc_error_; }
  double slowest() const { return airspeed_ - wind_.norm(); }

 private:
  // 1 / v along a course, and its integral over the course from 0 on.
  struct Slowness {
    double integral = 0, here = 0;
  };
  double slowness(double course) const;
  void fill_table();

  double airspeed_;
  Vec2 wind_;
  std::vector<Slowness> table_;  // empty without wind
  double arc_error_ = 0;
};

}  // namespace skein::solve
