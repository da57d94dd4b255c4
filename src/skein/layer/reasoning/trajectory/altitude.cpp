// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/altitude.h"

#include <algorithm>

namespace skein::reasoning {
namespace {

constexpr double kNear = 6;      // flight in every direction [s]
constexpr double kFar = 150;     // flight that is looked ahead [s]
constexpr double kGrowth = 1.3;  // each look further ahead is at this many times the last
constexpr int kDirections = 12;
constexpr double kClimbReserve = 0.8;  // part of the climb rate that is counted on
constexpr double kSpacing = 50;        // of looks at the ground along a route [m]

}  // namespace

double altitude_over(const Terrain& ground, const Vec2& position, const Vec2& velocity,
                     double height, double climb_rate) {
  double highest = ground.elevation_msl(position);
  for (const double turn : {-1.2, -0.6, 0.0, 0.6, 1.2}) {
    const Vec2 v = velocity.norm() * geo::unit(geo::bearing(velocity) + turn);
    for (double t = kNear / 3; t <= kNear; t += kNear / 3)
      highest = std::max(highest, ground.elevation_msl(position + t * v));
  }
  // The aircraft may be ordered to turn at any time, so the high ground that it must be
  // able to climb over may lie in any direction.
  const double speed = velocity.norm();
  for (int k = 0; k < kDirections; ++k) {
    const Vec2 v =
        speed * geo::unit(geo::bearing(velocity) + 2 * geo::kPi * k / kDirections);
    for (double t = kNear * kGrowth; t <= kFar; t *= kGrowth) {
      const double climbed = kClimbReserve * climb_rate * t;
      highest = std::max(highest, ground.elevation_msl(position + t * v) - climbed);
    }
  }
  return highest + height;
}

double highest_along(const Terrain& ground, const std::vector<Vec2>& points) {
  double highest = ground.elevation_msl(points.front());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2& from = points[i];
    const Vec2 leg = points[(i + 1) % points.size()] - from;
    const int looks = 1 + static_cast<int>(leg.norm() / kSpacing);
    for (int k = 0; k <= looks; ++k)
      highest = std::max(
          highest, ground.elevation_msl(from + leg * (static_cast<double>(k) / looks)));
  }
  return highest;
}

}  // namespace skein::reasoning
