// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "skein/geo/gdal/gdal_handles.h"
#include "skein/geo/vec.h"

namespace skein::environment {

/// Six numbers as GDAL orders them: x = c0 + c1 p + c2 q, y = c3 + c4 p + c5 q.
using Affine = std::array<double, 6>;
inline Vec2 affine(const Affine& c, const Vec2& p) {
  return {c[0] + c[1] * p.x() + c[2] * p.y(), c[3] + c[4] * p.x() + c[5] * p.y()};
}

/// Where a raster lies on the Earth.
struct Georeference {
  int columns = 0, rows = 0;
  bool geographic = false;         ///< its axes are latitude and longitude
  bool around = false;             ///< its columns go once around the Earth
  double vertical_unit = 0;        ///< of its heights, by its system [m]; 0: not said
  bool depths = false;             ///< its system counts downwards
  Affine geo{};                    ///< pixel to the raster's system, affine
  Affine inverse{};                ///< and back
  geo::GdalTransform to_raster;    ///< WGS 84 degrees to the raster's system
  geo::GdalTransform from_raster;  ///< and back
};

}  // namespace skein::environment
