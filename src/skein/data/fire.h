#pragma once

#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/geo/vec.h"

namespace skein {

/// "At `time` the ground at `point` was (not) burning", as an agent believes it: the
/// point comes from the aircraft's estimated position.
struct FireReading {
  Time time;
  EntityId aircraft;
  Vec2 point = Vec2::Zero();  ///< [m]
  double point_sd = 0;        ///< of the point, per axis [m]
  bool inside = false;
};

/// Two successive readings of one aircraft that differ: the boundary passed between them.
struct Crossing {
  Time time;  ///< of the later reading
  EntityId aircraft;
  Vec2 point = Vec2::Zero();  ///< middle of the two readings [m]
  Vec2 track = Vec2::Zero();  ///< from the earlier to the later point [m]
  double point_sd = 0;        ///< of the position, per axis [m]
  bool entered = false;       ///< the later reading is inside
};

/// One point of a believed boundary.
struct BoundaryPoint {
  Vec2 position = Vec2::Zero();  ///< [m]
  Vec2 normal = Vec2::Zero();    ///< outward unit normal
  double sigma = 0;              ///< standard deviation along the normal [m]
  double sigma_growth = 0;       ///< d sigma/dt while nothing is observed [m/s]
  double rate = 0;               ///< believed speed along the normal [m/s]
  /// Major semi-axis of the 1-sigma ellipse of the position [m]; zero where only the
  /// uncertainty along the normal is known.
  Vec2 major_axis = Vec2::Zero();
};

/// A believed boundary: closed rings of points, outer ones positive (see geo/polygon.h).
struct BoundaryEstimate {
  Time time;
  std::vector<std::vector<BoundaryPoint>> rings;
};

/// What is known of a fire before the first observation.
struct PerimeterPrior {
  Vec2 origin = Vec2::Zero();  ///< believed origin of the fire [m]
  double radius = 500;         ///< believed distance of the boundary at the start [m]
  double radius_sd = 104;      ///< of the boundary at the start [m]
  double rate = 3;             ///< believed spread [m/s]
  double rate_sd = 0.058;      ///< of the spread [m/s]
  Vec2 wind = Vec2::Zero();    ///< believed drift of the boundary [m/s]
  double wind_sd = 1;          ///< per axis, of the drift that is not known [m/s]
};

}  // namespace skein
