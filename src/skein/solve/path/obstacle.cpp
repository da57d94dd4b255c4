// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/obstacle.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/model/path/flight_plan.h"

namespace skein::solve {
namespace {

// Against planned flights, time is looked at in pieces no longer than this [s].
constexpr double kFlightLeaf = 0.05;

// Where a straight path between two points is at a part of it.
template <class T>
T between(const T& a, const T& b, double part) {
  return a + part * (b - a);
}

double edges_gap(const Obstacle& o, const geo::Ring& ring, const Vec2& p, const Vec2& q) {
  double min = math::kInfinity;
  const auto n = ring.size();
  for (std::int32_t i = o.first; i < o.first + o.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    min = std::min(min, distance(p, q, ring[k], ring[(k + 1) % n]));
  }
  // On or across an edge: as deep as can be known from here.
  return min > 0 ? min : -1;
}

// How far a chord flown in `span` stays from the room of another's chord.
double flight_gap(const Obstacle& o, const FlightElement& e, const Span& span,
                  const Vec3& p, const Vec3& q) {
  const Span when =
      Span{e.start + span.begin - o.behind, e.start + span.end + o.ahead}.cut(
          {o.time, o.end});
  if (when.empty()) return math::kInfinity;
  const double whole = o.end - o.time;
  const double first = whole > 0 ? (when.begin - o.time) / whole : 0;
  const double last = whole > 0 ? (when.end - o.time) / whole : 1;
  const double z0 = between(o.altitude_a, o.altitude_b, first);
  const double z1 = between(o.altitude_a, o.altitude_b, last);
  const double room = o.height + vertical_chord_error(e, span.end - span.begin);
  const double above = -std::max(p.z(), q.z()) - std::max(z0, z1) - room;
  const double below = std::min(z0, z1) - room + std::min(p.z(), q.z());
  if (above > 0 || below > 0) return math::kInfinity;
  return distance(geo::horizontal(p), geo::horizontal(q), between(o.a, o.b, first),
                  between(o.a, o.b, last)) -
         o.radius;
}

double disc_contact(const Obstacle& o, const FlightElement& e, const Span& span,
                    double leaf) {
  const bool still = o.velocity.isZero();
  if (still && e.wind.isZero()) {
    if (distance_without_wind(o.a, e, span) >= o.radius - kDepth) return -1;
    if (leaf == math::kInfinity) return span.begin;
  }
  const auto gap = [&](const Span& s, const Vec3& p, const Vec3& q) {
    if (still) return distance(o.a, geo::horizontal(p), geo::horizontal(q)) - o.radius;
    const double since = e.start - o.time;
    return distance(o.a, geo::horizontal(p) - (since + s.begin) * o.velocity,
                    geo::horizontal(q) - (since + s.end) * o.velocity) -
           o.radius;
  };
  return first_near(e, span, model::position(e, span.begin), model::position(e, span.end),
                    kDepth, leaf, gap);
}

}  // namespace

double first_contact(const Obstacle& o, const RingShape& ring, const FlightElement& e,
                     double leaf) {
  Span span = Span{0, e.duration}.cut({o.from - e.start, o.until - e.start});
  if (span.empty()) return -1;
  const double since = e.start - o.time;
  span = span.cut(o.kind == Obstacle::Kind::kMover
                      ? within_altitudes(e, o.low + o.climb * since,
                                         o.high + o.climb * since, o.climb)
                      : within_altitudes(e, o.low, o.high));
  if (span.empty()) return -1;
  switch (o.kind) {
    case Obstacle::Kind::kDisc:
    case Obstacle::Kind::kMover:
      return disc_contact(o, e, span, leaf);
    case Obstacle::Kind::kInside:
      return ring.contains(geo::horizontal(model::position(e, span.begin))) ? span.begin
                                                                            : -1;
    case Obstacle::Kind::kEdges:
      return first_near(
          e, span, model::position(e, span.begin), model::position(e, span.end), kDepth,
          leaf, [&](const Span&, const Vec3& p, const Vec3& q) {
            return edges_gap(o, *ring.corners, geo::horizontal(p), geo::horizontal(q));
          });
    case Obstacle::Kind::kFlight:
      return first_near(e, span, model::position(e, span.begin),
                        model::position(e, span.end), kDepth, std::min(leaf, kFlightLeaf),
                        [&](const Span& s, const Vec3& p, const Vec3& q) {
                          return flight_gap(o, e, s, p, q);
                        });
  }
  return -1;
}

}  // namespace skein::solve
