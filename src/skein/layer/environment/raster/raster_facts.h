// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "skein/layer/environment/raster/georeference.h"

namespace skein::environment {

/// What a raster says about one of its bands.
struct BandInfo {
  int number = 1;               ///< from 1
  std::string name;             ///< variable, GRIB element or description; may be empty
  std::string standard_name;    ///< CF standard name; may be empty
  std::string unit;             ///< as written in the file; may be empty
  std::optional<double> utc_s;  ///< valid time, seconds since 1970 UTC
  std::optional<double> height_m;  ///< of the level, where the file gives one
};

/// What a raster says about itself.
struct RasterFacts {
  int columns = 0, rows = 0;
  Affine geo{};        ///< pixel to the raster's system
  std::string system;  ///< its coordinate reference system, as WKT 2
  std::vector<BandInfo> bands;
};

}  // namespace skein::environment
