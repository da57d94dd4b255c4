// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "skein/data/perimeter/fire.h"

namespace skein::perimeter {

/// A believed boundary as one sequence of points with arc lengths: the rings one after
/// the other. What strategies choose from.
class BoundaryLine {
 public:
  explicit BoundaryLine(const BoundaryEstimate& boundary);

  bool empty() const { return points_.empty(); }
  std::size_t size() const { return points_.size(); }
  const BoundaryPoint& operator[](std::size_t i) const { return points_[i]; }

  /// Length of all rings [m].
  double length() const { return length_; }
  /// Arc length at point i, counted through all rings [m].
  double arc(std::size_t i) const { return arcs_[i]; }
  /// Distance to the next point of the same ring [m].
  double spacing(std::size_t i) const { return spacing_[i]; }

  /// The next point of the same ring, in the ring's direction or against it.
  std::size_t next(std::size_t i, bool forward) const;

  /// The point nearest to `p`. The line must not be empty.
  std::size_t nearest(const Vec2& p) const;

  /// Unit tangent of the ring at point i, fire on its right.
  Vec2 tangent(std::size_t i) const;

 private:
  std::vector<BoundaryPoint> points_;
  std::vector<double> arcs_;
  std::vector<double> spacing_;
  std::vector<std::size_t> ring_begin_;  // of each point's ring
  std::vector<std::size_t> ring_end_;
  double length_ = 0;
};

/// The point beyond `point`, seen from `from`, that makes an aircraft cross the believed
/// boundary there: `reach` [m] along the normal, on the far side.
/// Reference: [Rabinovich18] section 2.7 (50 % interval: reach = 0.6745 sigma).
Vec2 crossing_aim(const BoundaryPoint& point, const Vec2& from, double reach);

}  // namespace skein::perimeter
