#include "model/path/point_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/path/path_geometry.h"

namespace skein::model {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTimeTolerance = 1e-6;  // of time_to_point [s]
constexpr int kMarch = 64;               // steps through a turning circle

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
  double turn = kInfinity;
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
  double turn = std::atan2(dy, x) + std::atan2(1, straight);
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
  const double bearing = std::atan2(dy, p.x);
  const double half = std::acos(cosine);
  Solution best;
  for (const double direction : {bearing + half, bearing - half}) {
    const double c = std::cos(direction), s = std::sin(direction);
    // Left turn until the common tangent: the course is across the line of centres.
    double left = geo::kPi / 2 - direction;
    if (left < 0) left += 2 * geo::kPi;
    // From the contact of the circles to the point, clockwise about the second centre.
    const double from_contact = direction + geo::kPi;
    const double to_point = std::atan2(p.y + 1 - 2 * s, p.x - 2 * c);
    const double right = geo::wrap_2pi(to_point - from_contact);
    if (left + right < best.length()) best = {left, right, false, false};
  }
  return best;
}

Solution solve(const Relative& p, bool inside) {
  return inside ? solve_inside(p) : solve_outside(p);
}

// One smooth piece of the race between the path length and the distance flown.
struct Race {
  const Pose& from;
  const Vec2& point;
  double airspeed, radius;
  const Vec2& wind;

  // Distance still missing after `time` and its rate of change; `inside` says in which
  // kind of piece the time is, which rounding at its ends must not change.
  struct Gap {
    double value, rate;
  };
  Gap gap(double time, bool inside) const {
    const Relative p = relative(from, point - wind * time, radius);
    const Solution path = solve(p, inside);
    const double end = from.course + (p.mirrored ? -path.end() : path.end());
    // Outside, the length grows by its last direction times the shift of the point. (The
    // rate is not used inside.)
    return {path.length() * radius - airspeed * time,
            -wind.dot(geo::unit(end)) - airspeed};
  }

  // Earliest time in [low, high] with gap <= 0, or infinite.
  double first_root(double low, double high, bool inside) const {
    // At the cuts themselves rounding would decide between the limits from both sides.
    low += kTimeTolerance / 10;
    high -= kTimeTolerance / 10;
    if (low > high) return kInfinity;
    const double at_low = gap(low, inside).value;
    if (at_low <= 0) return low;
    return inside ? first_root_inside(low, high) : root_outside(low, high, at_low);
  }

  // Outside, the gap falls all the way, at least by the smallest ground speed.
  double root_outside(double low, double high, double at_low) const {
    high = std::min(high, low + at_low / (airspeed - wind.norm()) + kTimeTolerance);
    double time = low;
    for (int i = 0; i < 60; ++i) {
      const Gap here = gap(time, false);
      (here.value > 0 ? low : high) = time;
      double next = time - here.value / here.rate;
      if (std::abs(next - time) < kTimeTolerance / 2) return std::clamp(next, low, high);
      if (high - low < kTimeTolerance) break;
      if (next <= low || next >= high) {
        // Newton leaves the bracket: the root is beyond its end, or near it.
        if (gap(high, false).value > 0) return kInfinity;
        next = (low + high) / 2;
      }
      time = next;
    }
    return high;
  }

  // Inside a turning circle the gap may rise and fall: march, then halve.
  double first_root_inside(double low, double high) const {
    // Two full turns reach every point.
    high = std::min(high, 4 * geo::kPi * radius / airspeed);
    const double step = (high - low) / kMarch;
    const double start = low;
    for (int i = 1; i <= kMarch; ++i) {
      const double time = start + i * step;
      if (gap(time, true).value > 0) {
        low = time;
        continue;
      }
      high = time;
      while (high - low > kTimeTolerance / 2) {
        const double middle = (low + high) / 2;
        (gap(middle, true).value > 0 ? low : high) = middle;
      }
      return high;
    }
    return kInfinity;
  }
};

// Times at which the moving point crosses a turning circle, in order.
struct Cuts {
  std::array<double, 5> time{};
  std::size_t count = 0;

  void insert(double t) {
    std::size_t at = count++;
    for (; at > 0 && time[at - 1] > t; --at) time[at] = time[at - 1];
    time[at] = t;
  }
};

Cuts circle_crossings(const Pose& from, const Vec2& point, double radius,
                      const Vec2& wind) {
  Cuts cuts;
  const double w2 = wind.squaredNorm();
  for (const double side : {-1.0, 1.0}) {
    const Vec2 centre =
        from.position + side * radius * geo::turned_right(geo::unit(from.course));
    const Vec2 d = point - centre;
    const double b = d.dot(wind);
    const double root2 = b * b - w2 * (d.squaredNorm() - radius * radius);
    if (root2 <= 0) continue;
    const double root = std::sqrt(root2);
    for (const double t : {(b - root) / w2, (b + root) / w2})
      if (t > 0) cuts.insert(t);
  }
  return cuts;
}

}  // namespace

double length_to_point(const Pose& from, const Vec2& point, double radius) {
  const Relative p = relative(from, point, radius);
  if (p.x == 0 && p.y == 0) return 0;
  return radius * solve(p, inside_circle(p)).length();
}

Path path_to_point(const Pose& from, const Vec2& point, double radius) {
  const Relative p = relative(from, point, radius);
  if (p.x == 0 && p.y == 0) return {};
  const Solution found = solve(p, inside_circle(p));
  const double side = (found.right ? 1 : -1) * (p.mirrored ? -1 : 1);
  Path path;
  if (found.turn > 0)
    path.push_back({from.position, from.course, found.turn * radius, side / radius});
  const Pose middle = path.empty() ? from : end_of(path.back());
  if (found.rest > 0)
    path.push_back({middle.position, middle.course, found.rest * radius,
                    found.straight ? 0 : -side / radius});
  return path;
}

double time_to_point(const Pose& from, const Vec2& point, double airspeed, double radius,
                     const Vec2& wind) {
  const double w2 = wind.squaredNorm();
  if (w2 >= airspeed * airspeed) return kInfinity;
  const double still = length_to_point(from, point, radius) / airspeed;
  if (w2 == 0 || still == 0) return still;

  const Race race{from, point, airspeed, radius, wind};
  Cuts cuts = circle_crossings(from, point, radius, wind);
  cuts.insert(kInfinity);
  double low = 0;
  for (std::size_t i = 0; i < cuts.count; ++i) {
    const double high = cuts.time[i];
    const double probe = std::isinf(high) ? low + 1 : (low + high) / 2;
    const bool inside = inside_circle(relative(from, point - wind * probe, radius));
    const double time = race.first_root(low, high, inside);
    if (!std::isinf(time)) return time;
    low = high;
  }
  return kInfinity;
}

}  // namespace skein::model
