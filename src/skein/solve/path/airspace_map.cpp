// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/airspace_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/model/path/flight_plan.h"
#include "skein/role/terrain.h"

namespace skein::solve {
namespace {

// Rings with more get an index.
constexpr std::size_t kManyCorners = 24;

}  // namespace

AirspaceMap::AirspaceMap(const PathQuery& query) : query_(query) {
  if (query_.airspace == nullptr) return;
  Pieces pieces;
  std::int32_t index = 0;
  for (const Zone& zone : query_.airspace->zones) {
    timed_ |= std::isfinite(zone.from) || std::isfinite(zone.until);
    add_pieces(zone, index++, pieces);
    rings_.emplace_back();
    const auto* ring = std::get_if<geo::Ring>(&zone.area);
    if (ring != nullptr && ring->size() > kManyCorners)
      rings_.back().emplace(geo::Region{*ring});
  }
  index = 0;
  for (const MovingObstacle& mover : query_.airspace->movers)
    add_pieces(mover, index++, pieces);
  timed_ |= !query_.airspace->movers.empty();
  for (const PlannedFlight& flight : query_.airspace->flights) {
    timed_ = true;
    add_pieces(flight, static_cast<std::int32_t>(flights_.size()), pieces);
    flights_.push_back(&flight);
  }
  keep(std::move(pieces));
}

void AirspaceMap::ask(const PathQuery& query) {
  SKEIN_CHECK(query.airspace == query_.airspace && query.terrain == query_.terrain);
  query_ = query;
}

void AirspaceMap::keep(Pieces pieces) {
  std::vector<BoxForest::Entry> entries;
  entries.reserve(pieces.boxes.size());
  auto id = static_cast<std::int32_t>(obstacles_.size());
  for (const Box& box : pieces.boxes) entries.push_back({box, id++});
  obstacles_.insert(obstacles_.end(), pieces.obstacles.begin(), pieces.obstacles.end());
  forest_.add(std::move(entries));
}

void AirspaceMap::add(const PlannedFlight& flight) {
  Pieces pieces;
  add_pieces(flight, static_cast<std::int32_t>(flights_.size()), pieces);
  flights_.push_back(&flight);
  timed_ = true;
  keep(std::move(pieces));
}

RingShape AirspaceMap::ring_of(const Obstacle& o) const {
  const bool edged =
      o.kind == Obstacle::Kind::kEdges || o.kind == Obstacle::Kind::kInside;
  if (!edged) return {};
  const auto i = static_cast<std::size_t>(o.index);
  return {&std::get<geo::Ring>(zone(i).area), rings_[i] ? &*rings_[i] : nullptr};
}

bool AirspaceMap::within(const Vec2& p) const {
  return (p.array() >= query_.south_west.array()).all() &&
         (p.array() <= query_.north_east.array()).all();
}

double AirspaceMap::edge_contact(const FlightElement& e, const Box& box,
                                 double leaf) const {
  const Vec2 min = query_.south_west, max = query_.north_east;
  if (box.low[0] >= min.x() && box.low[1] >= min.y() && box.high[0] <= max.x() &&
      box.high[1] <= max.y())
    return -1;
  const auto gap = [&](const Span&, const Vec3& p, const Vec3& q) {
    const Vec2 low = geo::horizontal(p).cwiseMin(geo::horizontal(q)) - min;
    const Vec2 high = max - geo::horizontal(p).cwiseMax(geo::horizontal(q));
    return std::min(low.minCoeff(), high.minCoeff());
  };
  return first_near(e, {0, e.duration}, e.p_N, model::position(e, e.duration), kDepth,
                    leaf, gap);
}

double AirspaceMap::ground_contact(const FlightElement& e) const {
  if (query_.terrain == nullptr) return -1;
  const double speed = e.airspeed + e.wind.norm();
  // The margin shrinks no faster than this.
  const double climb_at_end = e.climb_rate + e.climb_acceleration * e.duration;
  const double closing = kSteepest * speed - std::min({0.0, e.climb_rate, climb_at_end});
  double t = 0;
  while (true) {
    const Vec3 p = model::position(e, t);
    const double margin = -p.z() - query_.ground_clearance -
                          query_.terrain->elevation_msl(geo::horizontal(p));
    if (margin < -kDepth) return t;
    if (t >= e.duration) return -1;
    t = std::min(e.duration, t + std::max(margin / closing, kMinLook / speed));
  }
}

AirspaceMap::Contact AirspaceMap::contact(const FlightElement& e, double leaf) const {
  const Box box = box_of(e);
  Contact first;
  const auto take = [&](double after, Blocker blocker, std::size_t index) {
    if (after >= 0 && (first.after < 0 || after < first.after))
      first = {after, blocker, index};
  };
  take(edge_contact(e, box, leaf), Blocker::kEdge, 0);
  const bool any = leaf == math::kInfinity;
  forest_.walk([&](const Box& b) { return !(any && first.after >= 0) && b.meets(box); },
               [&](std::int32_t id) {
                 const Obstacle& o = obstacles_[static_cast<std::size_t>(id)];
                 const Blocker blocker =
                     o.kind == Obstacle::Kind::kMover    ? Blocker::kMover
                     : o.kind == Obstacle::Kind::kFlight ? Blocker::kFlight
                                                         : Blocker::kZone;
                 take(first_contact(o, ring_of(o), e, leaf), blocker,
                      static_cast<std::size_t>(o.index));
               });
  if (!(any && first.after >= 0)) take(ground_contact(e), Blocker::kGround, 0);
  return first;
}

bool AirspaceMap::is_free(const FlightElement& element) const {
  return contact(element, math::kInfinity).after < 0;
}

bool AirspaceMap::is_free(const FlightPlan& plan) const {
  return std::all_of(plan.begin(), plan.end(),
                     [&](const FlightElement& e) { return is_free(e); });
}

std::vector<std::size_t> AirspaceMap::zones_met(const FlightPlan& plan) const {
  std::vector<std::size_t> met;
  for (const FlightElement& e : plan) {
    const Box box = box_of(e);
    forest_.walk([&](const Box& b) { return b.meets(box); },
                 [&](std::int32_t id) {
                   const Obstacle& o = obstacles_[static_cast<std::size_t>(id)];
                   const bool zone = o.kind != Obstacle::Kind::kMover &&
                                     o.kind != Obstacle::Kind::kFlight;
                   if (zone && first_contact(o, ring_of(o), e, math::kInfinity) >= 0)
                     met.push_back(static_cast<std::size_t>(o.index));
                 });
  }
  std::sort(met.begin(), met.end());
  met.erase(std::unique(met.begin(), met.end()), met.end());
  return met;
}

double AirspaceMap::room(const Vec3& p_N, double time, const Reach& reach,
                         double max) const {
  double room = max;
  const Vec2 p = geo::horizontal(p_N);
  const auto gap = [](double low, double high, double x) {
    return std::max({low - x, x - high, 0.0});
  };
  // Until a box can be met one has to come to it, or climb to it, or wait for it; what
  // has ended is never met.
  const auto to_box = [&](const Box& b) {
    if (time > b.high[3]) return math::kInfinity;
    const double across =
        math::hypot(gap(b.low[0], b.high[0], p.x()), gap(b.low[1], b.high[1], p.y()));
    const double up = gap(b.low[2], b.high[2], -p_N.z()) * reach.speed / reach.climb;
    return std::max({across, up, (b.low[3] - time) * reach.speed});
  };
  forest_.walk(
      [&](const Box& b) { return to_box(b) < room; },
      [&](std::int32_t id) {
        const Obstacle& o = obstacles_[static_cast<std::size_t>(id)];
        double away = 0;
        if (o.kind == Obstacle::Kind::kDisc) {
          away = (p - o.a).norm() - o.radius;
        } else if (o.kind == Obstacle::Kind::kEdges) {
          const geo::Ring& ring = *ring_of(o).corners;
          away = math::kInfinity;
          for (std::int32_t k = o.first; k < o.first + o.count; ++k) {
            const auto i = static_cast<std::size_t>(k);
            away = std::min(away, distance(p, ring[i], ring[(i + 1) % ring.size()]));
          }
        } else if (o.kind == Obstacle::Kind::kInside) {
          away = ring_of(o).contains(p) ? 0 : math::kInfinity;
        } else if (o.kind == Obstacle::Kind::kFlight) {
          away = distance(p, o.a, o.b) - o.radius;
        } else {
          // Something that moves comes nearer itself.
          const Vec2 there = o.a + (std::max(time, o.from) - o.time) * o.velocity;
          away = ((p - there).norm() - o.radius) / (1 + o.velocity.norm() / reach.speed);
        }
        const double up = gap(o.low, o.high, -p_N.z()) * reach.speed / reach.climb;
        const bool moves = o.kind == Obstacle::Kind::kMover;
        away = std::max({away, moves ? 0 : up, (o.from - time) * reach.speed});
        room = std::min(room, std::max(0.0, away));
      });
  return room;
}

}  // namespace skein::solve
