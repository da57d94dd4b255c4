// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/test/independent_paths.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace independent {
namespace {

constexpr Real kTouch = 1e-7L;  // what touches an obstacle is beside it [m]

// Where on the straight from a to b, as a part of it, the edge from c to d is.
bool meets_edge(Point a, Point b, Point c, Point d, Real& part) {
  const Point u = b - a, v = d - c;
  const Real cross = u.x * v.y - u.y * v.x;
  if (cross == 0) return false;
  const Point w = c - a;
  part = (w.x * v.y - w.y * v.x) / cross;
  const Real other = (w.x * u.y - w.y * u.x) / cross;
  return other >= 0 && other <= 1;
}

Real distance(Point p, Point a, Point b) {
  const Point u = b - a;
  const Real square = dot(u, u);
  const Real part =
      square == 0 ? 0 : std::clamp(dot(p - a, u) / square, Real(0), Real(1));
  return length(p - (a + part * u));
}

Real depth(const std::vector<Point>& polygon, Point p) {
  Real nearest = kNone;
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    nearest = std::min(nearest, distance(p, a, b));
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y))
      inside = !inside;
  }
  return inside ? nearest : -nearest;
}

// Between one crossing of the rim and the next all is inside or all is outside.
bool is_clear(const std::vector<Point>& polygon, Point a, Point b, Real allowed) {
  std::vector<Real> cuts = {0, 1};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    Real part = 0;
    const Point c = polygon[i], d = polygon[(i + 1) % polygon.size()];
    if (meets_edge(a, b, c, d, part) && part > 0 && part < 1) cuts.push_back(part);
  }
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    if (depth(polygon, a + (cuts[i] + cuts[i + 1]) / 2 * (b - a)) > allowed) return false;
  return true;
}

// A circle that is followed to one side, a corner, or an end.
struct Pivot {
  Point centre;
  Real radius = 0;
  int side = 1;     // +1 right
  int circle = -1;  // of the field
};

struct Leg {
  std::size_t to;
  Real course, time;
};

// All paths over pivots, the first of which are starts, the last goals.
class AllPaths {
 public:
  AllPaths(const Field& field, const Air& air) : field_(field), air_(air) {}

  void add(Pivot pivot) { pivots_.push_back(pivot); }
  void add_obstacles() {
    for (std::size_t i = 0; i < field_.circles.size(); ++i)
      for (const int side : {1, -1})
        add({field_.circles[i].centre, field_.circles[i].radius, side,
             static_cast<int>(i)});
    for (const auto& polygon : field_.polygons)
      for (const Point corner : polygon) add({corner});
  }
  /// Of the first `starts` and last `goals` pivots; courses count where these are
  /// circles.
  Real least(std::size_t starts, std::size_t goals, Real first_course, Real last_course);

 private:
  struct Arrival {
    Real time;
    std::size_t at;
    Real course;
    bool operator<(const Arrival& other) const { return time > other.time; }
  };

  void find_legs(std::size_t starts, std::size_t goals);
  // Time of an arc without what is common to all courses: of 1 / v, integrated.
  Real slowness(Real course) const;
  Real arc_time(const Pivot& pivot, Real from, Real turned) const {
    return pivot.radius * std::abs(slowness(from + pivot.side * turned) - slowness(from));
  }
  bool arc_clear(const Pivot& pivot, Real from, Real turned) const;

  const Field& field_;
  const Air& air_;
  std::vector<Pivot> pivots_;
  std::vector<std::vector<Leg>> legs_;  // by the pivot where they begin
};

// 1 / v = (sqrt(V^2 - w^2 sin^2 u) - w cos u) / (V^2 - w^2), u from the wind's course.
Real AllPaths::slowness(Real course) const {
  const Real w = length(air_.wind), v = air_.speed;
  if (w == 0) return course / v;
  const Real u = course - std::atan2(air_.wind.y, air_.wind.x);
  return (v * std::ellint_2(w / v, u) - w * std::sin(u)) / (v * v - w * w);
}

void AllPaths::find_legs(std::size_t starts, std::size_t goals) {
  legs_.assign(pivots_.size(), {});
  for (std::size_t i = 0; i + goals < pivots_.size(); ++i)
    for (std::size_t k = starts; k < pivots_.size(); ++k) {
      if (i == k) continue;
      const Pivot &a = pivots_[i], &b = pivots_[k];
      // D = L u + q right(u), L the straight, u its direction.
      const Point apart = b.centre - a.centre;
      const Real q = b.side * b.radius - a.side * a.radius, square = dot(apart, apart);
      const Real straight = square - q * q;
      if (square == 0 || straight < -kTouch) continue;
      const Real along = std::sqrt(std::max(Real(0), straight));
      const Point u = (1 / square) * (along * apart - q * right_of(apart));
      const Point begin = a.centre - a.side * a.radius * right_of(u);
      const Point end = b.centre - b.side * b.radius * right_of(u);
      if (!is_clear(field_, begin, end, kTouch)) continue;
      legs_[i].push_back({k, std::atan2(u.y, u.x), straight_time(air_, end - begin)});
    }
}

bool AllPaths::arc_clear(const Pivot& pivot, Real from, Real turned) const {
  if (turned * pivot.radius < kTouch) return true;
  const auto at = [&](Real turn) {
    return pivot.centre -
           pivot.side * pivot.radius * right_of(unit(from + pivot.side * turn));
  };
  const auto turn_to = [&](Point direction) {
    return wrapped(pivot.side *
                   (std::atan2(direction.y, direction.x) + pivot.side * kPi / 2 - from));
  };
  for (std::size_t i = 0; i < field_.circles.size(); ++i) {
    if (static_cast<int>(i) == pivot.circle) continue;
    const Circle& other = field_.circles[i];
    const Point apart = other.centre - pivot.centre;
    Real nearest =
        std::min(length(at(0) - other.centre), length(at(turned) - other.centre));
    if (turn_to(apart) < turned)
      nearest = std::min(nearest, std::abs(length(apart) - pivot.radius));
    if (nearest < other.radius - kTouch) return false;
  }
  for (const auto& polygon : field_.polygons) {
    std::vector<Real> cuts = {0, turned};
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point a = polygon[i] - pivot.centre;
      const Point b = polygon[(i + 1) % polygon.size()] - pivot.centre, u = b - a;
      const Real half = dot(a, u) / dot(u, u);
      const Real square =
          half * half - (dot(a, a) - pivot.radius * pivot.radius) / dot(u, u);
      if (square < 0) continue;
      for (const Real root : {std::sqrt(square), -std::sqrt(square)}) {
        const Real part = root - half;
        if (part < 0 || part > 1) continue;
        const Real turn = turn_to(a + part * u);
        if (turn < turned) cuts.push_back(turn);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
      if (depth(polygon, at((cuts[i] + cuts[i + 1]) / 2)) > kTouch) return false;
  }
  return true;
}

Real AllPaths::least(std::size_t starts, std::size_t goals, Real first_course,
                     Real last_course) {
  find_legs(starts, goals);
  std::priority_queue<Arrival> open;
  // By pivot and leg: the earliest begin of that leg.
  std::vector<std::vector<Real>> begun;
  for (const auto& legs : legs_) begun.emplace_back(legs.size(), kNone);
  for (std::size_t i = 0; i < starts; ++i) open.push({0, i, first_course});
  Real best = kNone;
  while (!open.empty()) {
    const Arrival now = open.top();
    open.pop();
    if (now.time >= best) break;
    const Pivot& pivot = pivots_[now.at];
    if (now.at + goals >= pivots_.size()) {
      const Real turned = wrapped(pivot.side * (last_course - now.course));
      if (pivot.radius == 0 || arc_clear(pivot, now.course, turned))
        best = std::min(best, now.time + arc_time(pivot, now.course, turned));
      continue;
    }
    for (std::size_t k = 0; k < legs_[now.at].size(); ++k) {
      const Leg& leg = legs_[now.at][k];
      const Real turned = wrapped(pivot.side * (leg.course - now.course));
      const Real begin = now.time + arc_time(pivot, now.course, turned);
      if (begin >= begun[now.at][k] || begin + leg.time >= best) continue;
      if (!arc_clear(pivot, now.course, turned)) continue;
      begun[now.at][k] = begin;
      open.push({begin + leg.time, leg.to, leg.course});
    }
  }
  return best;
}

}  // namespace

Point operator+(Point a, Point b) {
  return {a.x + b.x, a.y + b.y};
}
Point operator-(Point a, Point b) {
  return {a.x - b.x, a.y - b.y};
}
Point operator*(Real k, Point a) {
  return {k * a.x, k * a.y};
}
Real dot(Point a, Point b) {
  return a.x * b.x + a.y * b.y;
}
Real length(Point a) {
  return std::hypot(a.x, a.y);
}
Point unit(Real course) {
  return {std::cos(course), std::sin(course)};
}
Point right_of(Point a) {
  return {-a.y, a.x};
}
Real wrapped(Real angle) {
  constexpr Real kRounding = 1e-10L;
  Real turned = std::fmod(angle, 2 * kPi);
  if (turned < 0) turned += 2 * kPi;
  return turned > 2 * kPi - kRounding ? 0 : turned;
}

Real depth(const Field& field, Point p) {
  Real deepest = -kNone;
  for (const Circle& c : field.circles)
    deepest = std::max(deepest, c.radius - length(p - c.centre));
  for (const auto& polygon : field.polygons)
    deepest = std::max(deepest, depth(polygon, p));
  return deepest;
}

bool is_clear(const Field& field, Point a, Point b, Real allowed) {
  for (const Circle& c : field.circles)
    if (distance(c.centre, a, b) < c.radius - allowed) return false;
  return std::all_of(
      field.polygons.begin(), field.polygons.end(),
      [&](const auto& polygon) { return is_clear(polygon, a, b, allowed); });
}

Real straight_time(const Air& air, Point leg) {
  const Real way = length(leg);
  if (way == 0) return 0;
  const Point u = (1 / way) * leg;
  const Real along = dot(u, air.wind), across = dot(right_of(u), air.wind);
  return way / (along + std::sqrt(air.speed * air.speed - across * across));
}

Real point_time(const Field& field, const Air& air, Point from, Point to) {
  AllPaths all(field, air);
  all.add({from});
  all.add_obstacles();
  all.add({to});
  return all.least(1, 1, 0, 0);
}

Real dense_point_time(const Field& field, const Air& air, Point from, Point to,
                      int points) {
  Field corners;
  for (const Circle& c : field.circles) {
    std::vector<Point> around;
    for (int i = 0; i < points; ++i)
      around.push_back(c.centre +
                       c.radius / std::cos(kPi / points) * unit(2 * kPi * i / points));
    corners.polygons.push_back(around);
  }
  corners.polygons.insert(corners.polygons.end(), field.polygons.begin(),
                          field.polygons.end());
  return point_time(corners, air, from, to);
}

Real route_length(const Field& field, Pose from, Pose to, Real radius) {
  const Air still{1, {}};
  AllPaths all(field, still);
  const auto circles = [&](const Pose& pose) {
    for (const int side : {1, -1})
      all.add({pose.at + side * radius * right_of(unit(pose.heading)), radius, side});
  };
  circles(from);
  all.add_obstacles();
  circles(to);
  return all.least(2, 2, from.heading, to.heading);
}

}  // namespace independent
