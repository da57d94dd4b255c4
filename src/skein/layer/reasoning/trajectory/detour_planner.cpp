// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/detour_planner.h"

#include <algorithm>

#include "skein/base/math.h"
#include "skein/geo/clip.h"

namespace skein::reasoning {
namespace {

constexpr double kOutside = 1;  // corners of detours are this much further out [m]
// Of discs and of arcs around corners [m]: finer would cost more than it saves.
constexpr double kTolerance = 3;

geo::Region outlines(std::span<const Zone> zones) {
  geo::Region rings;
  for (const Zone& zone : zones) rings.push_back(outline(zone, kTolerance));
  return rings;
}

// Whether segments cross, their ends not counted.
bool cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double from = geo::cross(b - a, c - a), to = geo::cross(b - a, d - a);
  const double begin = geo::cross(d - c, a - c), end = geo::cross(d - c, b - c);
  return from * to < 0 && begin * end < 0;
}

// Corners where a tight string around the area would bend.
void add_bends(const geo::Ring& ring, std::vector<Vec2>& corners) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2& before = ring[(i + ring.size() - 1) % ring.size()];
    const Vec2& after = ring[(i + 1) % ring.size()];
    // Rings run with the area on their right, so that it bulges where they turn right.
    if (geo::cross(ring[i] - before, after - ring[i]) > 0) corners.push_back(ring[i]);
  }
}

geo::Region without_holes(const geo::Region& region) {
  geo::Region outer;
  for (const geo::Ring& ring : region)
    if (geo::signed_area(ring) > 0) outer.push_back(ring);
  return geo::clean_touching(outer, geo::FillRule::kNonZero);
}

}  // namespace

DetourPlanner::DetourPlanner(std::span<const Zone> zones, double clearance)
    : area_(geo::grown(outlines(zones), clearance, kTolerance)),
      border_(area_),
      outer_(without_holes(area_)) {
  for (const geo::Ring& ring : area_) {
    Eigen::AlignedBox2d& box = boxes_.emplace_back();
    for (const Vec2& p : ring) box.extend(p);
  }
  for (const geo::Ring& ring :
       geo::grown(outlines(zones), clearance + kOutside + 2 * kTolerance, kTolerance))
    add_bends(ring, corners_);
}

bool DetourPlanner::allows(const Vec2& from, const Vec2& to) const {
  if (!allows((from + to) / 2)) return false;
  const Eigen::AlignedBox2d box = Eigen::AlignedBox2d(from).extend(to);
  for (std::size_t k = 0; k < area_.size(); ++k) {
    if (!box.intersects(boxes_[k])) continue;
    const geo::Ring& ring = area_[k];
    for (std::size_t i = 0; i < ring.size(); ++i)
      if (cross(from, to, ring[i], ring[(i + 1) % ring.size()])) return false;
  }
  return true;
}

Vec2 DetourPlanner::nearest_allowed(const Vec2& p) const {
  if (outer_.empty() || !outer_.contains(p)) return p;
  const Vec2 edge = outer_.nearest(p).point;
  const Vec2 out = edge - p;
  return out.norm() > 0 ? Vec2(edge + kTolerance * out.normalized()) : edge;
}

std::vector<Vec2> DetourPlanner::detour(const Vec2& from, const Vec2& to) const {
  std::vector<Vec2> path;
  const Vec2 start = nearest_allowed(from), goal = nearest_allowed(to);
  if (start != from) path.push_back(start);
  if (allows(start, goal)) {
    path.push_back(goal);
    return path;
  }
  // A* over the corners; what each sees is found out when its turn comes.
  std::vector<Vec2> places = corners_;
  places.push_back(start);
  places.push_back(goal);
  const std::size_t from_place = places.size() - 2, to_place = places.size() - 1;
  std::vector<double> cost(places.size(), math::kInfinity);
  std::vector<std::size_t> before(places.size(), from_place);
  std::vector<bool> done(places.size(), false);
  cost[from_place] = 0;
  while (!done[to_place]) {
    std::size_t next = places.size();
    double min = math::kInfinity;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double total = cost[i] + (goal - places[i]).norm();
      if (!done[i] && total < min) min = total, next = i;
    }
    if (next == places.size()) break;  // shut in
    done[next] = true;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double there = cost[next] + (places[i] - places[next]).norm();
      if (done[i] || there >= cost[i] || !allows(places[next], places[i])) continue;
      cost[i] = there;
      before[i] = next;
    }
  }
  if (done[to_place]) {
    std::vector<Vec2> bends;
    for (std::size_t i = before[to_place]; i != from_place; i = before[i])
      bends.push_back(places[i]);
    path.insert(path.end(), bends.rbegin(), bends.rend());
  }
  path.push_back(goal);
  return path;
}

}  // namespace skein::reasoning
