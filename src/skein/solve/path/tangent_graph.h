// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "skein/solve/path/airspace_map.h"
#include "skein/solve/path/ground_speed.h"

namespace skein::solve {

/// A circular obstacle: a disc, or a convex corner as a tiny one.
struct CircularObstacle {
  Vec2 centre = Vec2::Zero();  ///< [m]
  double radius = 0;           ///< [m]
  bool corner = false;
};

/// A route of arcs along circles with straights between. An arc may have no length.
struct Detour {
  struct Arc {
    CircularObstacle obstacle;
    int side = 1;       ///< +1 right, -1 left
    double course = 0;  ///< at its begin [rad]
    double turned = 0;  ///< 0 or above [rad]
  };
  std::vector<Arc> arcs;  ///< at least those at the start and the goal
  double time = 0;        ///< at the speeds over ground along it [s]
};

/// What a route around discs and corners has to be.
struct DetourRequest {
  Vec2 start = Vec2::Zero(), goal = Vec2::Zero();  ///< [m]
  double start_course = 0, goal_course = 0;        ///< [rad]
  /// Of the circles on which it leaves the start and comes to the goal [m]; 0: courses
  /// there are free.
  double turn_radius = 0;
  double start_time = 0;                         ///< [s]
  double start_altitude = 0, goal_altitude = 0;  ///< [m]
  double max_time = 1e300;  ///< routes that take longer are not looked for [s]
  int detours = 1;          ///< how many to look for
  /// Heuristic weight: 1 finds the quickest first, more finds one sooner that takes at
  /// most so many times longer.
  double heuristic_weight = 1;
};

/// How a search for routes ended.
struct Detours {
  std::vector<Detour> detours;  ///< the quickest first
  bool complete = false;  ///< all was looked at: there is no other route of this kind
  std::int64_t expansions =
      0;  ///< expansions; eight tangents, which are quickly looked at, are one
};

/// Routes of minimum time that consist of straights and arcs along circles: A* over the
/// common tangents, each looked at only when its turn comes.
///
/// For a point among discs (turn_radius 0) the route found is the shortest of all routes;
/// for an aircraft without wind it is the shortest of those that turn at the start and
/// the goal at turn_radius and along circles between, which can be flown where no circle
/// is smaller than turn_radius.
///
/// The tangent from a circle (c, r, side s) to another (c', r', s') has the course
///
///   psi = bearing(c' - c) - asin((s' r' - s r) / |c' - c|)
///
/// with s = +1 for right turns.
///
/// @param map  what straights and arcs must keep out of, as flown without wind at the
///             altitude that changes evenly over the route.
/// Cost:     of N circles at most N^2 tangents at each of at most 4 N^2 nodes;
///           in practice a small part. Looks at no more than `budget.expansions`.
Detours find_tangent_paths(const AirspaceMap& map,
                           std::span<const CircularObstacle> obstacles,
                           const GroundSpeed& speed, const DetourRequest& request,
                           const PlanningBudget& budget);

}  // namespace skein::solve
