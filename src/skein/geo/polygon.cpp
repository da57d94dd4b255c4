// SPDX-License-Identifier: Apache-2.0
#include "skein/geo/polygon.h"

#include <algorithm>
#include <limits>

#include "skein/base/check.h"

namespace skein::geo {

double signed_area(std::span<const Vec2> ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    twice += cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
  return twice / 2;
}

double area(const Region& region) {
  double sum = 0;
  for (const Ring& ring : region) sum += signed_area(ring);
  return sum;
}

double length(std::span<const Vec2> ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    sum += (ring[(i + 1) % ring.size()] - ring[i]).norm();
  return sum;
}

double length(const Region& region) {
  double sum = 0;
  for (const Ring& ring : region) sum += length(std::span<const Vec2>(ring));
  return sum;
}

bool ray_crosses(const Vec2& a, const Vec2& b, const Vec2& p) {
  return (a.x() > p.x()) != (b.x() > p.x()) &&
         p.y() < (b.y() - a.y()) * (p.x() - a.x()) / (b.x() - a.x()) + a.y();
}

bool contains(std::span<const Vec2> ring, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    if (ray_crosses(ring[i], ring[j], p)) inside = !inside;
  return inside;
}

bool contains(const Region& region, const Vec2& p) {
  bool inside = false;
  for (const Ring& ring : region) inside ^= contains(std::span<const Vec2>(ring), p);
  return inside;
}

Vec2 outward_normal(const Vec2& tangent) {
  return turned_left(tangent.normalized());
}

Ring resample(std::span<const Vec2> ring, int count) {
  SKEIN_CHECK(count > 0 && !ring.empty(), count, ring.size());
  const double total = length(ring);
  Ring points;
  points.reserve(static_cast<std::size_t>(count));
  std::size_t i = 0;
  double walked = 0;  // arc length at ring[i]
  for (int k = 0; k < count; ++k) {
    const double target = total * k / count;
    double edge = (ring[(i + 1) % ring.size()] - ring[i]).norm();
    while (i + 1 < ring.size() && walked + edge <= target) {
      walked += edge;
      ++i;
      edge = (ring[(i + 1) % ring.size()] - ring[i]).norm();
    }
    const double along = edge > 0 ? std::clamp((target - walked) / edge, 0.0, 1.0) : 0;
    points.push_back(ring[i] + along * (ring[(i + 1) % ring.size()] - ring[i]));
  }
  return points;
}

Ring resample_by_spacing(std::span<const Vec2> ring, double spacing, int min) {
  SKEIN_CHECK(spacing > 0, spacing);
  const double requested = std::ceil(length(ring) / spacing);
  SKEIN_CHECK(requested < 1e8, requested);
  return resample(ring, std::max(min, static_cast<int>(requested)));
}

}  // namespace skein::geo
