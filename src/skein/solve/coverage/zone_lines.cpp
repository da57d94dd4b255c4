// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/coverage/zone_lines.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "skein/base/math.h"
#include "skein/geo/boundary_index.h"
#include "skein/model/path/flight_plan.h"

namespace skein::solve {
namespace {

// Half a turn of radius 1, forwards (x) and to its side (y), as corners of chords around
// it, so that it is not taken for smaller than it is.
class HalfTurn {
 public:
  HalfTurn() {
    constexpr double kPart = geo::kPi / kChords;
    const double corner = 1 / math::cos(kPart / 2);
    points[0] = Vec2::Zero();
    for (std::size_t k = 0; k < kChords; ++k) {
      const double angle = (static_cast<double>(k) + 0.5) * kPart;
      points[k + 1] = {corner * math::sin(angle), 1 - corner * math::cos(angle)};
    }
    points.back() = {0, 2};
  }

  static constexpr std::size_t kChords = 8;
  std::array<Vec2, kChords + 2> points;
};

// Where a half turn can begin without entering a zone.
class TurnRoom {
 public:
  TurnRoom(const ZoneRings& zones, double radius) : zones_(zones), radius_(radius) {}

  // How far before p, on the line along unit vector u, the last such place lies [m]; far
  // away when there is none within a few turns.
  double pull_back(const Vec2& p, const Vec2& u) const {
    constexpr int kSteps = 32, kHalvings = 8;
    if (radius_ <= 0 || free(p, u)) return 0;
    const double step = radius_ / 8;
    for (int k = 1; k <= kSteps; ++k) {
      double room = k * step, none = room - step;
      if (!free(p - room * u, u)) continue;
      for (int i = 0; i < kHalvings; ++i) {
        const double middle = (room + none) / 2;
        (free(p - middle * u, u) ? room : none) = middle;
      }
      return room;
    }
    return 1e300;
  }

 private:
  bool free(const Vec2& p, const Vec2& u) const {
    return free(p, u, geo::turned_right(u)) || free(p, u, -geo::turned_right(u));
  }

  bool free(const Vec2& p, const Vec2& u, const Vec2& side) const {
    std::array<Vec2, HalfTurn::kChords + 2> arc;
    for (std::size_t k = 0; k < arc.size(); ++k)
      arc[k] = p + radius_ * (turn_.points[k].x() * u + turn_.points[k].y() * side);
    return !zones_.entered_by(arc);
  }

  const ZoneRings& zones_;
  double radius_;
  HalfTurn turn_;
};

// From a place to a disc around a zone; 0 or less within that.
double distance_to(const Zone& zone, const Vec2& p) {
  if (const auto* disc = std::get_if<Disc>(&zone.area))
    return (p - disc->centre).norm() - disc->radius;
  const geo::Ring& ring = std::get<geo::Ring>(zone.area);
  double reach = 0;
  for (const Vec2& corner : ring) reach = std::max(reach, (corner - ring[0]).norm());
  return (p - ring[0]).norm() - reach;
}

bool deep_inside(const Zone& zone, const Vec2& p) {
  constexpr double kDeep = 0.1;  // as exact as planned paths are [m]
  if (const auto* disc = std::get_if<Disc>(&zone.area))
    return (p - disc->centre).norm() < disc->radius - kDeep;
  const geo::Ring& ring = std::get<geo::Ring>(zone.area);
  return geo::contains(ring, p) && geo::BoundaryIndex({ring}).nearest(p).distance > kDeep;
}

}  // namespace

std::vector<SweepLine> clear_of(const std::vector<SweepLine>& lines,
                                const ZoneRings& zones, const ZoneRoom& room) {
  if (zones.empty()) return lines;
  const TurnRoom turns(zones, room.turn_radius);
  std::vector<SweepLine> out;
  std::vector<Span> closed;
  for (const SweepLine& line : lines) {
    const double length = (line.b - line.a).norm();
    if (length <= 0) continue;
    const Vec2 t = (line.b - line.a) / length;
    closed.clear();
    zones.near(line.a, t, room.distance, closed);
    std::sort(closed.begin(), closed.end(),
              [](const Span& x, const Span& y) { return x.low < y.low; });
    double free_from = 0;
    const auto leave = [&](double until) {
      const double a = free_from + turns.pull_back(line.a + free_from * t, -t);
      const double b = until - turns.pull_back(line.a + until * t, t);
      if (b - a > 1e-3) out.push_back({line.a + a * t, line.a + b * t, line.cell});
    };
    for (const Span& s : closed) {
      if (s.low > free_from) leave(std::min(s.low, length));
      free_from = std::max(free_from, s.high);
      if (free_from >= length) break;
    }
    if (free_from < length) leave(length);
  }
  return out;
}

double time_within(const FlightPlan& plan, const std::vector<Zone>& zones) {
  constexpr double kStep = 0.05;
  double time = 0;
  for (const FlightElement& e : plan) {
    const Vec2 begin = geo::horizontal(e.p_N);
    const double reach = (e.airspeed + e.wind.norm()) * e.duration;
    std::vector<const Zone*> near;
    for (const Zone& zone : zones)
      if (distance_to(zone, begin) <= reach) near.push_back(&zone);
    if (near.empty()) continue;
    const int steps = std::max(1, static_cast<int>(std::ceil(e.duration / kStep)));
    for (int k = 0; k < steps; ++k) {
      const double t = e.duration * (k + 0.5) / steps;
      const Vec3 p_N = model::position(e, t);
      if (std::any_of(near.begin(), near.end(), [&](const Zone* zone) {
            return holds_at(*zone, -p_N.z(), e.start + t) &&
                   deep_inside(*zone, geo::horizontal(p_N));
          }))
        time += e.duration / steps;
    }
  }
  return time;
}

}  // namespace skein::solve
