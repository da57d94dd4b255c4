// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/geo/local_frame.h"
#include "skein/layer/environment/raster/grid_field.h"
#include "skein/role/terrain.h"

namespace skein::environment {

/// What holds where a file has no data.
enum class Outside {
  kError,  ///< loading fails
  kEdge,   ///< the nearest value goes on
};

struct RasterTerrainOptions {
  std::string file;       ///< a raster (see RasterFile) of elevations
  int band = 1;           ///< from 1; used when no name is given
  std::string band_name;  ///< description of the band; empty: by number
  std::string unit;  ///< of the elevations, whatever the file says; empty: as it says,
                     ///< and metres where it says none
  Outside outside = Outside::kError;  ///< where the file has no data within the area
  double area = 5000;  ///< half the side of the square about the origin [m]
  double spacing = 0;  ///< of the nodes kept in memory [m]; 0: a pixel's size
};

/// Ground from an elevation raster: reprojected into the local frame when loaded,
/// bilinear between nodes. Beyond the area that was loaded the values of its edge go on.
class RasterTerrain final : public Terrain {
 public:
  explicit RasterTerrain(GridField field);
  double elevation_msl(const Vec2& p) const override { return field_.at(p); }
  Vec2 gradient(const Vec2& p) const override { return field_.gradient(p); }
  double highest_msl() const override { return highest_; }
  const GridField& field() const { return field_; }

 private:
  GridField field_;
  double highest_;  // [m]
};

/// Loads a raster terrain about the frame's origin. Where it holds a sea floor (below
/// -500 m), whatever lies below 0 counts as the sea's surface, with a warning. Fails:
/// kNotFound, kBadInput as read_grid(); kBadInput also for options out of range,
///        for a unit that is no length, depths, and for values that are no elevation
///        (below -11500 m or above 9000 m, or numbers such as -9999 that stand for "no
///        data": most often the file does not declare it).
Result<std::unique_ptr<Terrain>> make_raster_terrain(const RasterTerrainOptions& options,
                                                     const geo::LocalFrame& frame,
                                                     std::vector<std::string>& warnings);

}  // namespace skein::environment
