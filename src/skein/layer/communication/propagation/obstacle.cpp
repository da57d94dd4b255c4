// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/propagation/obstacle.h"

#include <algorithm>

#include "skein/layer/communication/propagation/path_ends.h"

namespace skein::communication {
namespace {

bool sides_differ(double a, double b) {
  return (a > 0) != (b > 0);
}

bool crosses(const Vec2& p, const Vec2& q, const Vec2& a, const Vec2& b) {
  const Vec2 pq = q - p, ab = b - a;
  return sides_differ(geo::cross(pq, a - p), geo::cross(pq, b - p)) &&
         sides_differ(geo::cross(ab, p - a), geo::cross(ab, q - a));
}

bool is_crossed(const geo::Ring& ring, const Vec2& p, const Vec2& q) {
  for (std::size_t i = 0, before = ring.size() - 1; i < ring.size(); before = i++)
    if (crosses(p, q, ring[before], ring[i])) return true;
  return geo::contains(ring, p);
}

bool is_crossed(const Disc& disc, const Vec2& p, const Vec2& q) {
  const Vec2 pq = q - p, to_centre = disc.centre - p;
  const double square = pq.squaredNorm();
  const double part = square > 0 ? std::clamp(to_centre.dot(pq) / square, 0.0, 1.0) : 0;
  return (to_centre - part * pq).squaredNorm() < disc.radius * disc.radius;
}

}  // namespace

bool is_crossed(const Obstacle& obstacle, const Vec3& a, const Vec3& b) {
  const auto [from, to] = ordered_ends(a, b);
  // The part of the line between the heights of base and top.
  const double height = -from.z(), climb = from.z() - to.z();
  double begin = 0, end = 1;
  if (climb == 0) {
    if (height < obstacle.base_msl || height > obstacle.top_msl) return false;
  } else {
    const double at_base = (obstacle.base_msl - height) / climb;
    const double at_top = (obstacle.top_msl - height) / climb;
    begin = std::max(begin, std::min(at_base, at_top));
    end = std::min(end, std::max(at_base, at_top));
    if (begin > end) return false;
  }
  const Vec2 way = geo::horizontal(to) - geo::horizontal(from);
  const Vec2 p = geo::horizontal(from) + begin * way;
  const Vec2 q = geo::horizontal(from) + end * way;
  return std::visit([&](const auto& area) { return is_crossed(area, p, q); },
                    obstacle.area);
}

}  // namespace skein::communication
