// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/round_trip.h"

#include <algorithm>
#include <limits>

namespace skein::reasoning {
namespace {

constexpr double kOnePoint = 0.5;  // corners nearer than this are one [m]

// The share of the leg from a to b at which it meets the ring first.
std::optional<double> meets(const Vec2& a, const Vec2& b, const geo::Ring& ring) {
  if (geo::contains(ring, a)) return 0.0;
  std::optional<double> first;
  const Vec2 leg = b - a;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2& c = ring[i];
    const Vec2 side = ring[(i + 1) % ring.size()] - c;
    const double both = geo::cross(leg, side);
    if (both == 0) continue;  // along the side: its neighbours are met
    const double share = geo::cross(c - a, side) / both;
    const double on_side = geo::cross(c - a, leg) / both;
    if (share < 0 || share > 1 || on_side < 0 || on_side > 1) continue;
    first = std::min(first.value_or(share), share);
  }
  return first;
}

double to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 leg = b - a;
  const double square = leg.squaredNorm();
  const double share = square > 0 ? std::clamp((p - a).dot(leg) / square, 0.0, 1.0) : 0.0;
  return (a + share * leg - p).norm();
}

}  // namespace

FlyWaypoints round_trip(const std::vector<Vec2>& points, int laps, double altitude_msl) {
  FlyWaypoints route;
  for (const Vec2& point : points)
    if (route.points.empty() || (point - route.points.back().point).norm() >= kOnePoint)
      route.points.push_back({point, altitude_msl});
  while (route.points.size() > 1 &&
         (route.points.back().point - route.points.front().point).norm() < kOnePoint)
    route.points.pop_back();
  route.laps = route.points.size() > 1 ? laps : 1;
  return route;
}

std::optional<Vec2> into_zone(std::span<const Vec2> points, bool closed,
                              std::span<const Zone> zones) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool last = i + 1 == points.size();
    if (last && !closed && i > 0) break;
    const Vec2 &a = points[i], &b = points[last ? 0 : i + 1];
    std::optional<double> first;
    for (const Zone& zone : zones)
      if (const auto at = meets(a, b, outline(zone)))
        first = std::min(first.value_or(*at), *at);
    if (first) return a + *first * (b - a);
  }
  return {};
}

double distance_between(const Vec2& a, const Vec2& b, const geo::Ring& ring) {
  if (meets(a, b, ring)) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &c = ring[i], &d = ring[(i + 1) % ring.size()];
    nearest = std::min(
        {nearest, to_segment(a, c, d), to_segment(b, c, d), to_segment(c, a, b)});
  }
  return nearest;
}

}  // namespace skein::reasoning
