// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "skein/base/random.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/coverage/coverage.h"

namespace skein::solve {

/// A star-shaped ring of random corners, about 600 m around a random place.
inline geo::Ring random_ring(RandomStream& random, int corners, double ragged) {
  geo::Ring ring;
  const Vec2 centre(random.uniform(-300, 300), random.uniform(-300, 300));
  for (int i = 0; i < corners; ++i)
    ring.push_back(centre +
                   random.uniform(600 * (1 - ragged), 600) *
                       geo::unit(2 * geo::kPi * (i + 0.5 * random.uniform()) / corners));
  return ring;
}

/// Whether a straight of a plan passes a point at most `half` beside it.
inline bool beside_a_line(const std::vector<FlightPlan>& plans, const Vec2& p,
                          double half) {
  for (const FlightPlan& plan : plans)
    for (const FlightElement& e : plan) {
      if (e.turn_rate != 0) continue;
      const Vec2 a = geo::horizontal(e.p_N);
      const Vec2 leg = geo::horizontal(model::end_of(e).p_N) - a;
      const double length = leg.norm();
      if (length <= 0) continue;
      const double along = leg.dot(p - a) / length;
      if (along < -1e-3 || along > length + 1e-3) continue;
      if (std::abs(geo::cross(leg, p - a)) <= half * length) return true;
    }
  return false;
}

/// The distance of a point from a ring's edges; negative inside.
inline double distance_from(const geo::Ring& ring, const Vec2& p) {
  double near = 1e300;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2& a = ring[i];
    const Vec2 leg = ring[(i + 1) % ring.size()] - a;
    const double s = std::clamp(leg.dot(p - a) / leg.squaredNorm(), 0.0, 1.0);
    near = std::min(near, (p - a - s * leg).norm());
  }
  return geo::contains(ring, p) ? -near : near;
}

/// Whether a point is to be surveyed, and further than `distance` from all zones.
inline bool requested(const CoverageQuery& q, const Vec2& p, double distance) {
  if (!geo::contains(q.area, p)) return false;
  for (const geo::Ring& hole : q.holes)
    if (geo::contains(hole, p)) return false;
  return std::all_of(q.zones.begin(), q.zones.end(), [&](const Zone& z) {
    return distance_from(outline(z), p) > distance;
  });
}

/// Points of a grid over the area that no straight of a plan sees, of those that are
/// requested().
inline int missed(const CoverageQuery& q, const CoverageResult& r, double step,
                  double distance = 0) {
  int count = 0;
  for (double x = -1000; x <= 1600; x += step)
    for (double y = -1000; y <= 1600; y += step)
      if (requested(q, {x, y}, distance) &&
          !beside_a_line(r.plans, {x, y}, q.swath / 2 + 1e-3))
        ++count;
  return count;
}

}  // namespace skein::solve
