// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/obstacle_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "skein/base/math.h"

namespace skein::mixed {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMinSpacing = 2;  // of samples of the ground [m]
constexpr int kMaxSamples = 64;    // along a line
constexpr int kHalvings = 8;

struct Ray {
  Vec2 from, along;  // `along` has length 1
  Vec2 at(double distance) const { return from + distance * along; }
};

double to_ground(const Terrain& terrain, const Ray& ray, double altitude, double range) {
  const auto free = [&](double distance) {
    return terrain.elevation_msl(ray.at(distance)) < altitude;
  };
  if (!free(0)) return 0;
  const double spacing = std::max(kMinSpacing, range / kMaxSamples);
  for (double last = 0; last < range;) {
    double next = std::min(last + spacing, range);
    if (free(next)) {
      last = next;
      continue;
    }
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = (last + next) / 2;
      (free(middle) ? last : next) = middle;
    }
    return next;
  }
  return kInfinity;
}

// Where the ray enters, from outside.
double to_wall(const Disc& disc, const Ray& ray) {
  const Vec2 to = disc.centre - ray.from;
  const double middle = to.dot(ray.along);
  const double half = disc.radius * disc.radius - (to.squaredNorm() - middle * middle);
  return half < 0 || middle < 0 ? kInfinity : middle - std::sqrt(half);
}
double to_wall(const geo::Ring& ring, const Ray& ray) {
  double nearest = kInfinity;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec2 a = ring[k] - ray.from, side = ring[(k + 1) % ring.size()] - ring[k];
    const double across = geo::cross(ray.along, side);
    if (across == 0) continue;
    const double distance = geo::cross(a, side) / across;
    const double share = geo::cross(a, ray.along) / across;
    if (distance >= 0 && share >= 0 && share <= 1) nearest = std::min(nearest, distance);
  }
  return nearest;
}

}  // namespace

ObstacleDistances sweep(const Terrain& terrain, std::span<const Zone> zones,
                        const Vec3& p_N, double heading, Time now, double range) {
  const Vec2 place = geo::horizontal(p_N);
  const double altitude = -p_N.z();
  ObstacleDistances seen;
  seen.range = range;
  constexpr double kStep = 2 * geo::kPi / ObstacleDistances::kDirections;
  for (std::size_t k = 0; k < seen.distances.size(); ++k) {
    const Ray ray{place, geo::unit(heading + static_cast<double>(k) * kStep)};
    double& nearest = seen.distances[k];
    nearest = to_ground(terrain, ray, altitude, range);
    for (const Zone& zone : zones) {
      if (!holds_at(zone, altitude, now.seconds())) continue;
      const double wall =
          covers(zone, place)
              ? 0
              : std::visit([&](const auto& area) { return to_wall(area, ray); },
                           zone.area);
      nearest = std::min(nearest, wall);
    }
    if (nearest > range) nearest = kInfinity;
  }
  return seen;
}

}  // namespace skein::mixed
