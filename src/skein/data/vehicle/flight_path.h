// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/data/describe/describe.h"

namespace skein {

/// A point of a flight ahead.
struct PathPoint {
  float ahead = 0;                              ///< after the flight was planned [s]
  float north = 0, east = 0, altitude_msl = 0;  ///< [m]
};

constexpr auto describe(const PathPoint*) {
  using T = PathPoint;
  return described<T>(
      {"path_point"}, "A point of a flight ahead.",
      field("ahead", &T::ahead, unit::kSecond, "after the flight was planned"),
      field("north", &T::north, unit::kMetre, "of the origin"),
      field("east", &T::east, unit::kMetre, "of the origin"),
      field("altitude_msl", &T::altitude_msl, unit::kMetre, "above mean sea level"));
}

/// How an aircraft expects to fly from now on, as straight pieces between points.
struct FlightPath {
  std::vector<PathPoint> points;
  bool ends = false;  ///< at the last point; else it goes on from there
};

constexpr auto describe(const FlightPath*) {
  using T = FlightPath;
  return described<T>({"flight_path"}, "How an aircraft expects to fly from now on.",
                      field("points", &T::points, Storage::kCoded,
                            "straight pieces lead from one to the next"),
                      field("ends", &T::ends, "at the last; else it goes on from there"));
}

}  // namespace skein
