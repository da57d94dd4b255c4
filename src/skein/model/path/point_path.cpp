// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/point_path.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/model/path/path_geometry.h"

namespace skein::model {
namespace {

// Everything below happens in the frame of the aircraft: x ahead, y to the right, lengths
// in turn radii, and mirrored so that the point is on the right (y >= 0). The turning
// circles then have their centres at (0, 1) and (0, -1).
struct Relative {
  double x = 0, y = 0;
  bool mirrored = false;
};

Relative relative(const Pose& from, const Vec2& point, double radius) {
  const Vec2 along = geo::unit(from.course);
  const Vec2 d = (point - from.position) / radius;
  const double y = geo::cross(along, d);
  return {d.dot(along), std::abs(y), y < 0};
}

bool inside_circle(const Relative& p) {
  const double dy = p.y - 1;
  return p.x * p.x + dy * dy < 1;
}

// Two parts: a turn by `turn`, to the right when `right`; then `rest`, straight or an
// opposite turn. `end` is the final course, relative to the first.
struct Solution {
  double turn = math::kInfinity;
  double rest = 0;
  bool right = true;
  bool straight = true;
  double length() const { return turn + rest; }
  double end() const {
    const double side = right ? 1 : -1;
    return side * (straight ? turn : turn - rest);
  }
};

// Turn about the near centre, then straight; the point is outside of that circle.
// The tangent point leads the point's bearing, seen from the centre, by acos(1/d).
Solution turn_then_straight(double x, double y, bool right) {
  const double dy = y - 1;
  const double d2 = x * x + dy * dy;
  const double straight = std::sqrt(std::max(0.0, d2 - 1));
  // Course to the point along the tangent: its bearing from the centre plus atan(1/s).
  double turn = math::atan2(dy, x) + math::atan2(1, straight);
  if (turn < 0) turn += 2 * geo::kPi;
  if (turn > 2 * geo::kPi - 1e-12) turn = 0;  // straight ahead but for rounding
  return {turn, straight, right, true};
}

// The point outside both circles: the near side's turn is the shorter one.
Solution solve_outside(const Relative& p) {
  return turn_then_straight(p.x, p.y, true);
}

// The point inside the right circle: turn left, then right through the point; the second
// circle's centre is 2 away from the left centre and 1 from the point.
Solution solve_inside(const Relative& p) {
  const double dy = p.y + 1;  // from the left centre
  const double d2 = p.x * p.x + dy * dy;
  const double d = std::sqrt(d2);
  const double cosine = std::clamp((d2 + 3) / (4 * d), -1.0, 1.0);
  const double bearing = math::atan2(dy, p.x);
  const double half = math::acos(cosine);
  Solution best;
  for (const double direction : {bearing + half, bearing - half}) {
    const double c = math::cos(direction), s = math::sin(direction);
    // Left turn until the common tangent: the course is across the line of centres.
    double left = geo::kPi / 2 - direction;
    if (left < 0) left += 2 * geo::kPi;
    // From the contact of the circles to the point, clockwise about the second centre.
    const double from_contact = direction + geo::kPi;
    const double to_point = math::atan2(p.y + 1 - 2 * s, p.x - 2 * c);
    const double right = geo::wrap_2pi(to_point - from_contact);
    if (left + right < best.length()) best = {left, right, false, false};
  }
  return best;
}

Solution solve(const Relative& p, bool inside) {
  return inside ? solve_inside(p) : solve_outside(p);
}

}  // namespace

double length_to_point(const Pose& from, const Vec2& point, double radius) {
  const Relative p = relative(from, point, radius);
  if (p.x == 0 && p.y == 0) return 0;
  return radius * solve(p, inside_circle(p)).length();
}

PointPath shortest_to_point(const Pose& from, const Vec2& point, double radius) {
  const Relative p = relative(from, point, radius);
  if (p.x == 0 && p.y == 0) return {};
  const Solution found = solve(p, inside_circle(p));
  return {found.right != p.mirrored, found.straight, found.turn, found.rest};
}

Path path_to_point(const Pose& from, const Vec2& point, double radius) {
  const PointPath found = shortest_to_point(from, point, radius);
  const double side = found.right ? 1 : -1;
  Path path;
  if (found.first > 0)
    path.push_back({from.position, from.course, found.first * radius, side / radius});
  const Pose middle = path.empty() ? from : end_of(path.back());
  if (found.second > 0)
    path.push_back({middle.position, middle.course, found.second * radius,
                    found.straight ? 0 : -side / radius});
  return path;
}

}  // namespace skein::model
