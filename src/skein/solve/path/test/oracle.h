// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/data/airspace/airspace.h"
#include "skein/model/path/flight_plan.h"
#include "skein/role/terrain.h"

// What a place is in, by the definitions alone: a slow check that shares nothing with
// what it checks.
namespace skein::solve::test {

inline double edge_distance(const geo::Ring& ring, const Vec2& p) {
  double min = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i], u = ring[(i + 1) % ring.size()] - a;
    const double along = std::clamp(u.dot(p - a) / u.squaredNorm(), 0.0, 1.0);
    min = std::min(min, (a + along * u - p).norm());
  }
  return min;
}

/// How deep a place is in a zone [m]; negative outside.
inline double depth(const Zone& zone, const Vec3& p_N, double time) {
  if (!holds_at(zone, -p_N.z(), time)) return -1e9;
  const Vec2 p = geo::horizontal(p_N);
  if (const auto* disc = std::get_if<Disc>(&zone.area))
    return disc->radius - (p - disc->centre).norm();
  const auto& ring = std::get<geo::Ring>(zone.area);
  return (geo::contains(ring, p) ? 1 : -1) * edge_distance(ring, p);
}

inline double depth(const MovingObstacle& m, const Vec3& p_N, double time) {
  if (time < m.from || time > m.until) return -1e9;
  const Vec3 away = p_N - m.p_N - (time - m.time) * m.v_N;
  if (std::abs(away.z()) > m.height) return -1e9;
  return m.radius - geo::horizontal(away).norm();
}

inline double depth(const PlannedFlight& f, const Vec3& p_N, double time,
                    double step = 0.05) {
  const double begin = std::max(time - f.zone.behind, model::start_of(f.plan));
  const double end = std::min(time + f.zone.ahead, model::end_time_of(f.plan));
  double deepest = -1e9;
  for (double t = begin; t <= end; t += step) {
    const Vec3 away = p_N - model::moment_at(f.plan, t).p_N;
    if (std::abs(away.z()) <= f.height)
      deepest = std::max(deepest, f.zone.across - geo::horizontal(away).norm());
  }
  return deepest;
}

inline double depth(const Airspace& airspace, const Vec3& p_N, double time) {
  double deepest = -1e9;
  for (const Zone& z : airspace.zones) deepest = std::max(deepest, depth(z, p_N, time));
  for (const MovingObstacle& m : airspace.movers)
    deepest = std::max(deepest, depth(m, p_N, time));
  for (const PlannedFlight& f : airspace.flights)
    deepest = std::max(deepest, depth(f, p_N, time));
  return deepest;
}

/// The deepest place of a plan, looked at in steps of time.
inline double depth(const Airspace& airspace, const FlightPlan& plan, double step) {
  double deepest = -1e9;
  for (const FlightElement& e : plan) {
    const int count = static_cast<int>(std::ceil(e.duration / step)) + 1;
    for (int i = 0; i <= count; ++i) {
      const double t = e.duration * i / count;
      deepest = std::max(deepest, depth(airspace, model::position(e, t), e.start + t));
    }
  }
  return deepest;
}

/// How far elements are from joining in time, place and heading; the worst of all.
inline double gaps(const FlightPlan& plan) {
  double worst = 0;
  for (std::size_t i = 0; i + 1 < plan.size(); ++i) {
    const model::FlightMoment end = model::end_of(plan[i]);
    worst = std::max({worst, (end.p_N - plan[i + 1].p_N).norm(),
                      std::abs(geo::wrap_pi(end.heading - plan[i + 1].heading)),
                      std::abs(plan[i].start + plan[i].duration - plan[i + 1].start)});
  }
  return worst;
}

/// The largest jump of the climb rate, from and to level flight at the ends too [m/s].
inline double climb_jump(const FlightPlan& plan) {
  double worst = 0, rate = 0;
  for (const FlightElement& e : plan) {
    worst = std::max(worst, std::abs(e.climb_rate - rate));
    rate = e.climb_rate + e.climb_acceleration * e.duration;
  }
  return std::max(worst, std::abs(rate));
}

}  // namespace skein::solve::test
