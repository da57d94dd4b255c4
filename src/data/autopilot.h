#pragma once

#include <cstdint>
#include <variant>

#include "data/path.h"

namespace skein {

/// Follow a path over ground, then circle its end.
struct FollowPath {
  Path path;
};

/// Turn to a course over ground and hold it.
struct HoldCourse {
  double course = 0;  ///< [rad]
};

/// Circle a point.
struct Circle {
  Vec2 centre = Vec2::Zero();
  double radius = 100;    ///< [m]
  bool clockwise = true;  ///< on the map
};

struct AutopilotCommand {
  std::variant<FollowPath, HoldCourse, Circle> guidance = HoldCourse{};
  double altitude_msl = 0;  ///< [m]
};

/// How far the autopilot is with what it was told.
struct AutopilotStatus {
  double remaining = 0;    ///< along the path [m]; 0 when there is none
  double cross_track = 0;  ///< distance to the path [m], right positive
  bool done = false;       ///< the path's end has been passed
};

}  // namespace skein
