// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/model/path/flight_plan.h"
#include "skein/role/terrain.h"
#include "skein/solve/path/airspace_map.h"

// Single places and times of an AirspaceMap, and its conflicts in words.
namespace skein::solve {
namespace {

// How exactly the time of a conflict is reported, with words and without [s].
constexpr double kReported = 0.01, kMet = 0.2;
// Depth is looked for during this time after a conflict begins [s].
constexpr double kDepthTime = 2;

// Standing at a place, for a moment.
FlightElement standing(const Vec3& p_N, double time) {
  FlightElement e;
  e.start = time;
  e.p_N = p_N;
  return e;
}

double depth_in_ring(const geo::Ring& ring, const Vec2& p) {
  if (!geo::contains(ring, p)) return 0;
  double min = math::kInfinity;
  for (std::size_t i = 0; i < ring.size(); ++i)
    min = std::min(min, distance(p, ring[i], ring[(i + 1) % ring.size()]));
  return min;
}

}  // namespace

double AirspaceMap::depth_at(const Contact& c, const Vec3& p_N, double time) const {
  const Vec2 p = geo::horizontal(p_N);
  switch (c.blocker) {
    case Blocker::kZone: {
      const Zone& z = zone(c.index);
      if (const auto* disc = std::get_if<Disc>(&z.area))
        return disc->radius - (p - disc->centre).norm();
      return depth_in_ring(std::get<geo::Ring>(z.area), p);
    }
    case Blocker::kMover: {
      const MovingObstacle& m = query_.airspace->movers[c.index];
      return m.radius -
             (p - geo::horizontal(m.p_N) - (time - m.time) * geo::horizontal(m.v_N))
                 .norm();
    }
    case Blocker::kFlight: {
      const PlannedFlight& f = *flights_[c.index];
      double min = math::kInfinity;
      constexpr int kLooks = 64;
      for (int i = 0; i <= kLooks; ++i) {
        const double t =
            time - f.zone.behind + (f.zone.ahead + f.zone.behind) * i / kLooks;
        if (t < model::start_of(f.plan) || t > model::end_time_of(f.plan)) continue;
        min =
            std::min(min, (geo::horizontal(model::moment_at(f.plan, t).p_N) - p).norm());
      }
      return f.zone.across - min;
    }
    case Blocker::kGround:
      return query_.terrain->elevation_msl(p) + query_.ground_clearance + p_N.z();
    case Blocker::kEdge:
      return std::max((query_.south_west - p).maxCoeff(),
                      (p - query_.north_east).maxCoeff());
  }
  return 0;
}

Conflict AirspaceMap::in_words(const Contact& c, const FlightElement& e) const {
  Conflict out;
  out.blocker = c.blocker;
  out.index = c.index;
  out.time = e.start + c.after;
  out.p_N = model::position(e, c.after);
  constexpr int kLooks = 20;
  for (int i = 0; i <= kLooks; ++i) {
    const double t = std::min(c.after + kDepthTime * i / kLooks, e.duration);
    out.depth = std::max(out.depth, depth_at(c, model::position(e, t), e.start + t));
  }
  std::string what;
  switch (c.blocker) {
    case Blocker::kZone:
      what = zone(c.index).name.empty() ? fmt::format("zone {}", c.index)
                                        : fmt::format("zone '{}'", zone(c.index).name);
      break;
    case Blocker::kMover:
      what = fmt::format("moving obstacle {}", c.index);
      break;
    case Blocker::kFlight:
      what = fmt::format("the room of aircraft {}'s plan", flights_[c.index]->who.value);
      break;
    case Blocker::kGround:
      what = fmt::format("the ground's clearance of {:g} m", query_.ground_clearance);
      break;
    case Blocker::kEdge:
      what = "what is outside of the map";
      break;
  }
  out.what = fmt::format(
      "in {} at {:.1f} m north, {:.1f} m east, {:.1f} m altitude, {:.1f} s, by {:.1f} m",
      what, out.p_N.x(), out.p_N.y(), -out.p_N.z(), out.time, out.depth);
  return out;
}

std::optional<Conflict> AirspaceMap::look(const FlightPlan& plan, double min_overlap,
                                          bool words) const {
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (is_free(plan[i])) continue;
    Contact c = contact(plan[i], min_overlap);
    // At the limit the finer look may pass what the coarser one does not.
    if (c.after < 0) c = contact(plan[i], math::kInfinity);
    Conflict conflict;
    if (words) {
      conflict = in_words(c, plan[i]);
    } else {
      conflict.blocker = c.blocker;
      conflict.index = c.index;
      conflict.time = plan[i].start + c.after;
      conflict.p_N = model::position(plan[i], c.after);
    }
    conflict.element = i;
    return conflict;
  }
  return std::nullopt;
}

std::optional<Conflict> AirspaceMap::first_conflict(const FlightPlan& plan) const {
  return look(plan, kReported, true);
}

std::optional<Conflict> AirspaceMap::first_meeting(const FlightPlan& plan) const {
  return look(plan, kMet, false);
}

std::optional<Conflict> AirspaceMap::conflict_at(const Vec3& p_N, double time) const {
  return first_conflict({standing(p_N, time)});
}

std::optional<double> AirspaceMap::free_from(const Vec3& p_N, double time) const {
  // Waiting for one thing may end in the next; each ends once.
  for (std::size_t i = 0; i <= obstacles_.size(); ++i) {
    const FlightElement e = standing(p_N, time);
    const Contact c = contact(e, math::kInfinity);
    if (c.after < 0) return time;
    if (c.blocker == Blocker::kGround || c.blocker == Blocker::kEdge) return std::nullopt;
    double until = time;
    if (c.blocker == Blocker::kZone) until = zone(c.index).until;
    if (c.blocker == Blocker::kFlight)
      for (const Obstacle& o : obstacles_)
        if (o.kind == Obstacle::Kind::kFlight &&
            o.index == static_cast<std::int32_t>(c.index) &&
            first_contact(o, {}, e, math::kInfinity) >= 0)
          until = std::max(until, o.until);
    if (c.blocker == Blocker::kMover) {
      const MovingObstacle& m = query_.airspace->movers[c.index];
      const double speed = geo::horizontal(m.v_N).norm();
      // Gone when it has moved by its whole width.
      until = speed > 0 ? std::min(m.until, time + 2 * m.radius / speed) : m.until;
    }
    if (!std::isfinite(until)) return std::nullopt;
    time = std::max(until, time) + 1e-6 * (1 + std::abs(time));
  }
  return std::nullopt;
}

std::optional<Vec3> AirspaceMap::nearest_free(const Vec3& p_N, double time) const {
  constexpr int kDirections = 64;
  constexpr double kFirst = 1, kGrowth = 1.15, kFurthest = 20'000;  // [m]
  std::vector<Vec3> directions = {Vec3(0, 0, -1), Vec3(0, 0, 1)};
  for (int i = 0; i < kDirections; ++i) {
    const Vec2 u = geo::unit(2 * geo::kPi * i / kDirections);
    directions.emplace_back(u.x(), u.y(), 0);
  }
  const auto free = [&](const Vec3& p) {
    return contact(standing(p, time), math::kInfinity).after < 0;
  };
  std::optional<Vec3> best;
  double min = math::kInfinity;
  for (double r = kFirst; r < kFurthest && !best; r *= kGrowth)
    for (const Vec3& u : directions) {
      if (!free(p_N + r * u)) continue;
      // Back along the same line to the border.
      double in = 0, out = r;
      while (out - in > 0.01) {
        const double half = (in + out) / 2;
        (free(p_N + half * u) ? out : in) = half;
      }
      if (out >= min) continue;
      min = out;
      best = p_N + out * u;
    }
  return best;
}

}  // namespace skein::solve
