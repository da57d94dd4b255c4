#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "skein/base/id.h"
#include "skein/geo/vec.h"

namespace skein {

/// Fly to a point and through it.
struct FlyTo {
  Vec2 point = Vec2::Zero();  ///< [m]
};

/// Follow the real edge of the fire with the in/out sensor.
struct FollowEdge {
  bool clockwise = true;      ///< around the fire, on the map
  Vec2 start = Vec2::Zero();  ///< where to look for the edge first [m]
  /// Believed direction of the edge there, fire on its right whichever way round; 0 =
  /// unknown.
  Vec2 tangent = Vec2::Zero();
  double angle = 0;  ///< between course and edge [rad]; 0 = the agent's own
};

/// Follow a line of points, once.
struct FollowLine {
  std::vector<Vec2> points;  ///< [m]
};

/// Fly a fixed course (a transect).
struct FlyCourse {
  double course = 0;  ///< [rad]
};

/// Circle a point until told otherwise.
struct Loiter {
  Vec2 centre = Vec2::Zero();
};

/// Fly through points, round and round.
struct FlyRoute {
  std::vector<Vec2> points;  ///< [m]
  int laps = 1;
  std::vector<EntityId> tell;  ///< whom to tell the own position directly, each second
};

/// Stay at a place that moves with another aircraft.
struct FollowLeader {
  EntityId leader;
  Vec2 offset = Vec2::Zero();  ///< ahead of the leader and to its right [m]
};

/// One order for one aircraft. Numbers grow; an agent keeps the newest.
struct Task {
  std::uint32_t number = 0;
  std::variant<Loiter, FlyTo, FollowEdge, FollowLine, FlyCourse, FlyRoute, FollowLeader>
      what = Loiter{};
};

}  // namespace skein
