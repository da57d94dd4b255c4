#include "layer/reasoning/planning/tasks/zone_lines.h"

#include <algorithm>
#include <cmath>

#include "geo/boundary_index.h"
#include "model/path/flight_plan.h"

namespace skein::planning {
namespace {

struct Span {
  double low, high;  // along a line [m]
};

// Where the line from a along unit vector t is within `distance` of the point p.
void near_point(const Vec2& a, const Vec2& t, const Vec2& p, double distance,
                std::vector<Span>& out) {
  const double off = geo::cross(t, p - a), at = t.dot(p - a);
  if (std::abs(off) >= distance) return;
  const double half = std::sqrt(distance * distance - off * off);
  out.push_back({at - half, at + half});
}

// Where it is within `distance` of the edge from p to q, between the edge's ends.
void near_edge(const Vec2& a, const Vec2& t, const Vec2& p, const Vec2& q,
               double distance, std::vector<Span>& out) {
  const double length = (q - p).norm();
  if (length <= 0) return;
  const Vec2 e = (q - p) / length;
  // Along the edge s0 + s k in [0, length], across it c0 + s c in [-distance, distance].
  double low = -1e300, high = 1e300;
  const auto within = [&](double at, double rate, double least, double most) {
    if (std::abs(rate) < 1e-12) {
      if (at < least || at > most) high = -1e300;
      return;
    }
    const double x = (least - at) / rate, y = (most - at) / rate;
    low = std::max(low, std::min(x, y));
    high = std::min(high, std::max(x, y));
  };
  within(e.dot(a - p), e.dot(t), 0, length);
  within(geo::cross(e, a - p), geo::cross(e, t), -distance, distance);
  if (low < high) out.push_back({low, high});
}

// Where it is inside the ring.
void inside(const Vec2& a, const Vec2& t, const geo::Ring& ring, std::vector<Span>& out) {
  std::vector<double> cuts;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2& p = ring[i];
    const Vec2& q = ring[i + 1 == ring.size() ? 0 : i + 1];
    const double cp = geo::cross(t, p - a), cq = geo::cross(t, q - a);
    if ((cp > 0) == (cq > 0)) continue;
    cuts.push_back(t.dot(p + cp / (cp - cq) * (q - p) - a));
  }
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 0; i + 1 < cuts.size(); i += 2)
    out.push_back({cuts[i], cuts[i + 1]});
}

struct Bounds {
  Vec2 least, most;
};

Bounds bounds_of(const std::vector<Vec2>& points) {
  Bounds b{points.front(), points.front()};
  for (const Vec2& p : points) {
    b.least = b.least.cwiseMin(p);
    b.most = b.most.cwiseMax(p);
  }
  return b;
}

bool overlap(const Bounds& a, const Bounds& b) {
  return (a.least.array() <= b.most.array()).all() &&
         (b.least.array() <= a.most.array()).all();
}

// Whether a polyline enters a ring. Needs two points or more.
bool enters(const std::vector<Vec2>& points, const geo::Ring& ring) {
  std::vector<Span> spans;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double length = (points[i + 1] - points[i]).norm();
    if (length <= 0) continue;
    const Vec2 t = (points[i + 1] - points[i]) / length;
    spans.clear();
    inside(points[i], t, ring, spans);
    for (const Span& s : spans)
      if (s.low < length && s.high > 0) return true;
  }
  return false;
}

// Where a half turn can begin without entering a zone.
class TurnRoom {
 public:
  TurnRoom(const std::vector<geo::Ring>& zones, double radius)
      : zones_(zones), radius_(radius) {
    for (const geo::Ring& ring : zones) bounds_.push_back(bounds_of(ring));
  }

  // How far before p, on the way along unit vector u, the last such place lies [m]; far
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
    // Chords around the arc, so that it is not taken for smaller than it is.
    constexpr int kChords = 16;
    constexpr double kPart = geo::kPi / kChords;
    const Vec2 centre = p + radius_ * side;
    const double corner = radius_ / std::cos(kPart / 2);
    std::vector<Vec2> arc = {p};
    for (int k = 0; k < kChords; ++k) {
      const double angle = (k + 0.5) * kPart;
      arc.push_back(centre + corner * (std::sin(angle) * u - std::cos(angle) * side));
    }
    arc.push_back(centre + radius_ * side);
    const Bounds box = bounds_of(arc);
    for (std::size_t i = 0; i < zones_.size(); ++i)
      if (overlap(box, bounds_[i]) && enters(arc, zones_[i])) return false;
    return true;
  }

  const std::vector<geo::Ring>& zones_;
  std::vector<Bounds> bounds_;
  double radius_;
};

// The ground track as a polyline.
std::vector<Vec2> track(const FlightPlan& plan) {
  std::vector<Vec2> points;
  for (const FlightElement& e : plan) {
    const int steps = std::max(
        1, static_cast<int>(std::ceil(std::abs(e.turn_rate) * e.duration / 0.1)));
    for (int k = 0; k <= steps; ++k)
      points.push_back(geo::horizontal(model::position(e, e.duration * k / steps)));
  }
  return points;
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
                                const std::vector<geo::Ring>& zones,
                                const ZoneRoom& room) {
  if (zones.empty()) return lines;
  const TurnRoom turns(zones, room.turn_radius);
  std::vector<SweepLine> out;
  std::vector<Span> closed;
  for (const SweepLine& line : lines) {
    const double length = (line.b - line.a).norm();
    if (length <= 0) continue;
    const Vec2 t = (line.b - line.a) / length;
    closed.clear();
    for (const geo::Ring& ring : zones) {
      inside(line.a, t, ring, closed);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        near_point(line.a, t, ring[i], room.distance, closed);
        near_edge(line.a, t, ring[i], ring[i + 1 == ring.size() ? 0 : i + 1],
                  room.distance, closed);
      }
    }
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

bool enters(const FlightPlan& plan, const std::vector<geo::Ring>& zones) {
  if (zones.empty() || plan.empty()) return false;
  const std::vector<Vec2> points = track(plan);
  const Bounds whole = bounds_of(points);
  return std::any_of(zones.begin(), zones.end(), [&](const geo::Ring& ring) {
    return overlap(whole, bounds_of(ring)) && enters(points, ring);
  });
}

double time_within(const FlightPlan& plan, const std::vector<Zone>& zones) {
  constexpr double kStep = 0.05;
  std::vector<geo::Ring> rings;
  for (const Zone& zone : zones) rings.push_back(outline(zone));
  double time = 0;
  for (const FlightElement& e : plan) {
    if (!enters({e}, rings)) continue;
    const int steps = std::max(1, static_cast<int>(std::ceil(e.duration / kStep)));
    for (int k = 0; k < steps; ++k) {
      const Vec2 p = geo::horizontal(model::position(e, e.duration * (k + 0.5) / steps));
      if (std::any_of(zones.begin(), zones.end(),
                      [&](const Zone& zone) { return deep_inside(zone, p); }))
        time += e.duration / steps;
    }
  }
  return time;
}

}  // namespace skein::planning
