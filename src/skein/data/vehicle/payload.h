// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"
#include "skein/data/vehicle/sensing.h"
#include "skein/geo/vec.h"

namespace skein {

// What the payload of an aircraft has seen, for records. `time` is when it was measured,
// `sensor` which of the aircraft's payload sensors did, from 0 in the scenario's order.

/// Where the gimbals of an aircraft's payload are to look from now on.
struct RegionOfInterest {
  std::optional<Vec3> place_N;  ///< [m]; none: straight down
};

constexpr auto describe(const RegionOfInterest*) {
  using T = RegionOfInterest;
  return described<T>({"region_of_interest"}, "Where gimbals are to look from now on.",
                      field("place", &T::place_N, axes::kPlace,
                            "in the local frame; null: straight down"));
}

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

constexpr auto describe(const Detection*) {
  using T = Detection;
  return described<T>(
      {"detection", "detections"}, "An object found in one picture of a camera.",
      field("time", &T::time, "of the picture"),
      field("entity_id", &T::aircraft, "whose camera"),
      field("sensor", &T::sensor, "which of its payload sensors"),
      field("object_id", &T::object, "what was found"),
      field("", &T::point, axes::kPlace, "where the aircraft believes it"),
      field("position_sd", &T::point_sd, unit::kMetre,
            "per axis: of the aircraft's own position and of the picture together"));
}

/// The ground in one picture, where the aircraft believes it.
struct Footprint {
  Time time;
  EntityId aircraft;
  std::uint32_t sensor = 0;
  std::array<Vec2, 4> corners{};  ///< in N, in the order of FootprintSample [m]
};

constexpr auto describe(const Footprint*) {
  using T = Footprint;
  return described<T>({"footprint", "footprints"}, "One picture: the ground in it.",
                      field("time", &T::time, "of the picture"),
                      field("entity_id", &T::aircraft, "whose camera"),
                      field("sensor", &T::sensor, "which of its payload sensors"),
                      field("corner", &T::corners, axes::kPlace,
                            "front left, front right, back right, back left, as the "
                            "aircraft believes them"));
}

/// What a rangefinder or LiDAR measured at one time, as it says it.
struct RangeScan {
  Time time;
  EntityId aircraft;
  std::uint32_t sensor = 0;
  std::vector<RangeSample> beams;  ///< all of that time
};

constexpr auto describe(const RangeScan*) {
  using T = RangeScan;
  return described<T>(
      {"range_scan", "ranges"}, "One scan of a LiDAR, or one sample of a rangefinder.",
      field("time", &T::time, "when it was measured"),
      field("entity_id", &T::aircraft, "whose sensor"),
      field("sensor", &T::sensor, "which of its payload sensors"),
      field("beams", &T::beams, Storage::kFloats, "of the scan, in its order"));
}

}  // namespace skein
