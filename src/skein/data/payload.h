#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/sensing.h"
#include "skein/geo/vec.h"

namespace skein {

// What the payload of an aircraft has seen, for records. `time` is when it was measured,
// `sensor` which of the aircraft's payload sensors did, from 0 in the scenario's order.

/// An object that a camera has found, where the aircraft believes it.
struct Detection {
  Time time;
  EntityId aircraft;
  std::uint32_t sensor = 0;
  std::uint32_t object = 0;  ///< GroundObject::id
  Vec2 point =
      Vec2::Zero();     ///< in N: the aircraft's estimated place and the picture [m]
  double point_sd = 0;  ///< of both together, per axis [m]
};

/// The ground in one picture, where the aircraft believes it.
struct Footprint {
  Time time;
  EntityId aircraft;
  std::uint32_t sensor = 0;
  std::array<Vec2, 4> corners{};  ///< in N, in the order of FootprintSample [m]
};

/// What a rangefinder or LiDAR measured at one time, as it says it.
struct RangeScan {
  Time time;
  EntityId aircraft;
  std::uint32_t sensor = 0;
  std::vector<RangeSample> beams;  ///< all of that time
};

}  // namespace skein
