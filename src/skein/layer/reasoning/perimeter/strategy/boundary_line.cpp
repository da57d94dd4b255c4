// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/strategy/boundary_line.h"

#include <limits>

#include "skein/base/check.h"
#include "skein/geo/vec.h"

namespace skein::perimeter {

BoundaryLine::BoundaryLine(const BoundaryEstimate& boundary) {
  for (const auto& ring : boundary.rings) {
    const std::size_t begin = points_.size();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      points_.push_back(ring[i]);
      arcs_.push_back(length_);
      spacing_.push_back(
          (ring[(i + 1) % ring.size()].position - ring[i].position).norm());
      length_ += spacing_.back();
      ring_begin_.push_back(begin);
      ring_end_.push_back(begin + ring.size());
    }
  }
}

std::size_t BoundaryLine::next(std::size_t i, bool forward) const {
  if (forward) return i + 1 == ring_end_[i] ? ring_begin_[i] : i + 1;
  return i == ring_begin_[i] ? ring_end_[i] - 1 : i - 1;
}

std::size_t BoundaryLine::nearest(const Vec2& p) const {
  SKEIN_CHECK(!empty());
  std::size_t best = 0;
  double best2 = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const double d2 = (points_[i].position - p).squaredNorm();
    if (d2 < best2) {
      best2 = d2;
      best = i;
    }
  }
  return best;
}

Vec2 BoundaryLine::tangent(std::size_t i) const {
  return geo::turned_right(points_[i].normal);
}

Vec2 crossing_aim(const BoundaryPoint& point, const Vec2& from, double reach) {
  const bool outside = (from - point.position).dot(point.normal) > 0;
  return point.position + (outside ? -reach : reach) * point.normal;
}

}  // namespace skein::perimeter
