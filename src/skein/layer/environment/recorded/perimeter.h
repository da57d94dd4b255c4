// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "skein/geo/polygon.h"

namespace skein::environment {

/// A polygon as a file gives it: nothing about it is checked.
struct RawPolygon {
  std::vector<Vec2> outer;
  std::vector<std::vector<Vec2>> holes;
};

/// All that a file says about a fire's outline at one time, before any repair. Points are
/// latitude and longitude [deg] as read, or north and east [m] once projected.
struct RawPerimeter {
  double time = 0;    ///< [s], from any origin that the whole series shares
  std::string place;  ///< file and feature, for messages
  std::vector<RawPolygon> polygons;
  std::vector<std::vector<Vec2>> lines;  ///< pieces of outline, open or closed
};

/// The burnt region at one time.
struct Perimeter {
  double time = 0;  ///< since the first perimeter [s]
  geo::Region region;
};

}  // namespace skein::environment
