// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <numbers>
#include <vector>

// Paths among obstacles in the plane, by definitions and complete enumeration: what
// planners claim is compared with them, and no code is shared. x is north, y is east,
// courses are from north to the right [rad].
namespace independent {

using Real = long double;
inline constexpr Real kPi = std::numbers::pi_v<Real>;
inline constexpr Real kNone = std::numeric_limits<Real>::infinity();

struct Point {
  Real x = 0, y = 0;
};
Point operator+(Point a, Point b);
Point operator-(Point a, Point b);
Point operator*(Real k, Point a);
Real dot(Point a, Point b);
Real length(Point a);
/// The unit vector along a course, and a vector turned a quarter to the right.
Point unit(Real course);
Point right_of(Point a);
/// `angle` without whole turns, in [0, 2 pi); what is within 1e-10 of a whole turn is 0.
Real wrapped(Real angle);

struct Pose {
  Point at;
  Real heading = 0;
};

struct Circle {
  Point centre;
  Real radius = 0;
};

/// Obstacles that hold always and at all altitudes.
struct Field {
  std::vector<Circle> circles;
  std::vector<std::vector<Point>> polygons;  // simple, in either sense
};

struct Air {
  Real speed = 20;  // through the air, above that of the wind
  Point wind;
};

/// How deep a point is in the obstacles; negative: how far from the nearest.
Real depth(const Field& field, Point p);
/// Whether a straight comes nowhere deeper than `allowed` into an obstacle.
bool is_clear(const Field& field, Point a, Point b, Real allowed);

/// Time over ground of a straight.
Real straight_time(const Air& air, Point leg);

/// The minimum time of a point that may turn at once and keeps out of all obstacles;
/// infinite when there is no path. Exact: the quickest path is made of straights and of
/// arcs along circles, and every straight that touches two of circles, corners and ends
/// is tried.
Real point_time(const Field& field, const Air& air, Point from, Point to);

/// The same by straights between many points around the circles: never below the exact
/// one, and near it.
Real dense_point_time(const Field& field, const Air& air, Point from, Point to,
                      int points);

/// The shortest path without wind of a turn at `radius`, straights and arcs along
/// circles, and a last turn at `radius`. Infinite when there is none.
Real route_length(const Field& field, Pose from, Pose to, Real radius);

}  // namespace independent
