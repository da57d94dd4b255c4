// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/coverage/zone_rings.h"

#include <algorithm>
#include <cmath>

#include "skein/model/path/flight_plan.h"

namespace skein::solve {
namespace {

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
  const auto within = [&](double at, double rate, double min, double max) {
    if (std::abs(rate) < 1e-12) {
      if (at < min || at > max) high = -1e300;
      return;
    }
    const double x = (min - at) / rate, y = (max - at) / rate;
    low = std::max(low, std::min(x, y));
    high = std::min(high, std::max(x, y));
  };
  within(e.dot(a - p), e.dot(t), 0, length);
  within(geo::cross(e, a - p), geo::cross(e, t), -distance, distance);
  if (low < high) out.push_back({low, high});
}

// Where it is inside the ring.
void spans_inside(const Vec2& a, const Vec2& t, const geo::Ring& ring,
                  std::vector<Span>& out) {
  std::vector<double> cuts;
  const Vec2* p = &ring.back();
  double cp = geo::cross(t, *p - a);
  for (const Vec2& q : ring) {
    const double cq = geo::cross(t, q - a);
    if ((cp > 0) != (cq > 0)) cuts.push_back(t.dot(*p + cp / (cp - cq) * (q - *p) - a));
    p = &q;
    cp = cq;
  }
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 0; i + 1 < cuts.size(); i += 2)
    out.push_back({cuts[i], cuts[i + 1]});
}

// Whether a segment and an edge cross.
bool cross(const Vec2& a, const Vec2& b, const Vec2& p, const Vec2& q) {
  const Vec2 t = b - a;
  const double cp = geo::cross(t, p - a), cq = geo::cross(t, q - a);
  if ((cp > 0) == (cq > 0)) return false;
  const double at = t.dot(p + cp / (cp - cq) * (q - p) - a);
  return at > 0 && at < t.squaredNorm();
}

bool apart(const Vec2& min, const Vec2& max, const Vec2& low, const Vec2& high) {
  return (min.array() > high.array()).any() || (max.array() < low.array()).any();
}

}  // namespace

ZoneRings::ZoneRings(std::vector<geo::Ring> rings) : rings_(std::move(rings)) {
  for (const geo::Ring& ring : rings_) {
    boxes_.push_back(box_of(ring, 0, ring.size()));
    runs_.emplace_back();
    for (std::size_t i = 0; i < ring.size(); i += kRun)
      runs_.back().push_back(box_of(ring, i, std::min(kRun, ring.size() - i)));
  }
}

ZoneRings::Box ZoneRings::box_of(const geo::Ring& ring, std::size_t from,
                                 std::size_t count) {
  Box box{ring[from], ring[from]};
  for (std::size_t i = from; i <= from + count; ++i) {
    const Vec2& p = ring[i < ring.size() ? i : i - ring.size()];
    box.min = box.min.cwiseMin(p);
    box.max = box.max.cwiseMax(p);
  }
  return box;
}

void ZoneRings::near(const Vec2& a, const Vec2& t, double distance,
                     std::vector<Span>& out) const {
  for (std::size_t k = 0; k < rings_.size(); ++k) {
    const Vec2 middle = (boxes_[k].min + boxes_[k].max) / 2;
    const double reach = (boxes_[k].max - middle).norm() + distance;
    if (std::abs(geo::cross(t, middle - a)) > reach) continue;
    const geo::Ring& ring = rings_[k];
    spans_inside(a, t, ring, out);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      near_point(a, t, ring[i], distance, out);
      near_edge(a, t, ring[i], ring[i + 1 == ring.size() ? 0 : i + 1], distance, out);
    }
  }
}

bool ZoneRings::inside(const Vec2& p) const {
  for (std::size_t i = 0; i < rings_.size(); ++i)
    if (!apart(p, p, boxes_[i].min, boxes_[i].max) && geo::contains(rings_[i], p))
      return true;
  return false;
}

bool ZoneRings::crossed_by(const Vec2& a, const Vec2& b) const {
  const Vec2 min = a.cwiseMin(b), max = a.cwiseMax(b);
  for (std::size_t k = 0; k < rings_.size(); ++k) {
    if (apart(min, max, boxes_[k].min, boxes_[k].max)) continue;
    const geo::Ring& ring = rings_[k];
    for (std::size_t r = 0; r < runs_[k].size(); ++r) {
      if (apart(min, max, runs_[k][r].min, runs_[k][r].max)) continue;
      for (std::size_t i = r * kRun; i < std::min((r + 1) * kRun, ring.size()); ++i)
        if (cross(a, b, ring[i], ring[i + 1 == ring.size() ? 0 : i + 1])) return true;
    }
  }
  return false;
}

bool ZoneRings::entered_by(std::span<const Vec2> points) const {
  if (points.empty()) return false;
  if (inside(points.front())) return true;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    if (crossed_by(points[i], points[i + 1])) return true;
  return false;
}

bool ZoneRings::entered_by(const FlightPlan& plan) const {
  constexpr double kSag = 0.05;  // of chords [m]
  for (const FlightElement& e : plan) {
    const Vec2 begin = geo::horizontal(e.p_N);
    // All of it lies within this box.
    const double fastest = e.airspeed + e.wind.norm();
    const Vec2 reach = Vec2::Constant(fastest * e.duration * (1 + 1e-9));
    const bool far = std::all_of(boxes_.begin(), boxes_.end(), [&](const Box& box) {
      return apart(begin - reach, begin + reach, box.min, box.max);
    });
    if (far) continue;
    // A track bends by no more than V |rate|: a chord of the time t by that / 8 t^2.
    const double bend = e.airspeed * std::abs(e.turn_rate);
    const double chord = bend > 0 ? std::sqrt(8 * kSag / bend) : e.duration;
    const int steps =
        chord > 0 ? std::max(1, static_cast<int>(std::ceil(e.duration / chord))) : 1;
    if (inside(begin)) return true;
    Vec2 from = begin;
    for (int k = 1; k <= steps; ++k) {
      const Vec2 to = geo::horizontal(model::position(e, e.duration * k / steps));
      if (crossed_by(from, to)) return true;
      from = to;
    }
  }
  return false;
}

}  // namespace skein::solve
