// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "skein/data/airspace/airspace.h"
#include "skein/data/vehicle/flight_plan.h"
#include "skein/geo/local_frame.h"

namespace skein::exchange {

/// A flight as files show it.
struct NamedPlan {
  std::string name;  ///< "aircraft 1"
  std::string word;  ///< of a connection, as seen on a map; else empty
  FlightPlan plan;
};

/// A place worth a mark.
struct Mark {
  enum class Kind { kStart, kGoal, kPlace };
  Kind kind = Kind::kPlace;
  std::string name;
  Vec3 p_N = Vec3::Zero();        ///< [m]
  std::optional<double> heading;  ///< of the air-relative velocity [rad]
};

/// What a flight is for: an area to cover, a line to patrol, a target's track.
struct Shape {
  std::string name;
  bool closed = false;       ///< an area
  bool left_out = false;     ///< a hole in an area
  std::vector<Vec2> points;  ///< [m]
};

/// All that files about plans show. Writers take values and give text; whoever calls them
/// writes it.
struct Document {
  std::string title;
  std::vector<NamedPlan> plans;
  std::vector<Zone> zones;
  std::vector<MovingObstacle> movers;
  std::vector<Mark> marks;
  std::vector<Shape> shapes;
  /// What people want to know, in their order: {"Time", "83.2 s"}.
  std::vector<std::pair<std::string, std::string>> facts;
  /// Where the plane is on Earth; without it there are metres only.
  std::optional<geo::LocalFrame> frame;
  bool has_altitude = false;  ///< altitudes were given, not only the map's plane
};

}  // namespace skein::exchange
