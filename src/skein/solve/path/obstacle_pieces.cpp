// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/obstacle.h"

namespace skein::solve {
namespace {

// Edges of a ring that are looked at together.
constexpr std::size_t kEdgesTogether = 4;
// Pieces of planned flights: no longer, and their chords no further off than this.
constexpr double kPieceTime = 10;    // [s]
constexpr double kPieceError = 0.5;  // [m]
// Flights that would take more pieces have longer ones, with a larger room.
constexpr double kMaxPieces = 20'000;
// What moves is cut into pieces that double from the time at which its place is known.
constexpr double kFirstPiece = 30;  // [s]
constexpr int kDoublings = 9;

Box box_around(const Vec2& a, const Vec2& b, double out, const Obstacle& o) {
  Box box;
  for (int i = 0; i < 2; ++i) {
    const auto k = static_cast<std::size_t>(i);
    box.low[k] = std::min(a[i], b[i]) - out;
    box.high[k] = std::max(a[i], b[i]) + out;
  }
  box.low[2] = o.low;
  box.high[2] = o.high;
  box.low[3] = o.from;
  box.high[3] = o.until;
  return box;
}

void push(Pieces& pieces, const Obstacle& obstacle, const Box& box) {
  pieces.obstacles.push_back(obstacle);
  pieces.boxes.push_back(box);
}

Box box_of_mover(const Obstacle& o) {
  if (!std::isfinite(o.from) || !std::isfinite(o.until)) {
    Box box;
    box.low.fill(-math::kInfinity);
    box.high.fill(math::kInfinity);
    box.low[3] = o.from;
    box.high[3] = o.until;
    return box;
  }
  Box box = box_around(o.a + (o.from - o.time) * o.velocity,
                       o.a + (o.until - o.time) * o.velocity, o.radius, o);
  const double begin = o.climb * (o.from - o.time), end = o.climb * (o.until - o.time);
  box.low[2] += std::min(begin, end);
  box.high[2] += std::max(begin, end);
  return box;
}

}  // namespace

void add_pieces(const Zone& zone, std::int32_t index, Pieces& pieces) {
  Obstacle o;
  o.index = index;
  o.low = zone.floor_msl;
  o.high = zone.ceiling_msl;
  o.from = zone.from;
  o.until = zone.until;
  if (const auto* disc = std::get_if<Disc>(&zone.area)) {
    o.a = disc->centre;
    o.radius = disc->radius;
    push(pieces, o, box_around(o.a, o.a, o.radius, o));
    return;
  }
  const auto& ring = std::get<geo::Ring>(zone.area);
  Vec2 min = ring.front(), max = ring.front();
  o.kind = Obstacle::Kind::kEdges;
  for (std::size_t i = 0; i < ring.size(); i += kEdgesTogether) {
    o.first = static_cast<std::int32_t>(i);
    o.count = static_cast<std::int32_t>(std::min(kEdgesTogether, ring.size() - i));
    Vec2 low = ring[i], high = ring[i];
    for (std::size_t k = i; k <= i + static_cast<std::size_t>(o.count); ++k) {
      low = low.cwiseMin(ring[k % ring.size()]);
      high = high.cwiseMax(ring[k % ring.size()]);
    }
    push(pieces, o, box_around(low, high, 0, o));
    min = min.cwiseMin(low);
    max = max.cwiseMax(high);
  }
  o.kind = Obstacle::Kind::kInside;
  push(pieces, o, box_around(min, max, 0, o));
}

void add_pieces(const MovingObstacle& mover, std::int32_t index, Pieces& pieces) {
  Obstacle o;
  o.kind = Obstacle::Kind::kMover;
  o.index = index;
  o.a = geo::horizontal(mover.p_N);
  o.velocity = geo::horizontal(mover.v_N);
  o.radius = mover.radius;
  o.low = -mover.p_N.z() - mover.height;
  o.high = -mover.p_N.z() + mover.height;
  o.climb = -mover.v_N.z();
  o.time = mover.time;
  const auto add = [&](double from, double until) {
    o.from = std::max(from, mover.from);
    o.until = std::min(until, mover.until);
    if (o.from <= o.until) push(pieces, o, box_of_mover(o));
  };
  double begin = 0, end = kFirstPiece;
  for (int i = 0; i < kDoublings; ++i) {
    add(o.time + begin, o.time + end);
    add(o.time - end, o.time - begin);
    begin = end;
    end *= 2;
  }
  add(o.time + begin, math::kInfinity);
  add(-math::kInfinity, o.time - begin);
}

void add_pieces(const PlannedFlight& flight, std::int32_t index, Pieces& pieces) {
  for (const FlightElement& e : flight.plan) {
    const double bend =
        std::max(e.airspeed * std::abs(e.turn_rate), std::abs(e.climb_acceleration));
    double max = kPieceTime;
    if (bend > 0) max = std::min(max, std::sqrt(8 * kPieceError / bend));
    const double requested = std::clamp(std::ceil(e.duration / max), 1.0, kMaxPieces);
    const int count = static_cast<int>(requested);
    const double h = e.duration / count;
    for (int i = 0; i < count; ++i) {
      const Vec3 a = model::position(e, i * h), b = model::position(e, (i + 1) * h);
      Obstacle o;
      o.kind = Obstacle::Kind::kFlight;
      o.index = index;
      o.a = geo::horizontal(a);
      o.b = geo::horizontal(b);
      o.radius = flight.zone.across + chord_error(e, h);
      o.altitude_a = -a.z();
      o.altitude_b = -b.z();
      o.height = flight.height + vertical_chord_error(e, h);
      o.low = std::min(o.altitude_a, o.altitude_b) - o.height;
      o.high = std::max(o.altitude_a, o.altitude_b) + o.height;
      o.time = e.start + i * h;
      o.end = o.time + h;
      o.ahead = flight.zone.ahead;
      o.behind = flight.zone.behind;
      // The other is there between t - behind and t + ahead.
      o.from = o.time - o.ahead;
      o.until = o.end + o.behind;
      push(pieces, o, box_around(o.a, o.b, o.radius, o));
    }
  }
}

}  // namespace skein::solve
