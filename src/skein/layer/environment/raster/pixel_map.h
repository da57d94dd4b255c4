// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/geo/local_frame.h"
#include "skein/layer/environment/raster/georeference.h"
#include "skein/layer/environment/raster/grid_field.h"

namespace skein::environment {

/// What to do with nodes of the requested grid for which the raster has no value.
enum class Missing {
  kError,    ///< refuse
  kNearest,  ///< take the value of the nearest node that has one
  kKeep,     ///< leave NaN
};

/// Column of a raster that goes once around the Earth, counted on beyond its ends.
inline int around(int column, int columns) {
  return (column % columns + columns) % columns;
}

/// A rectangle of pixels, values unpacked (scale * stored + offset); NaN where the file
/// declares that there is no value.
struct PixelWindow {
  /// In the raster; over the seam of one that goes around the Earth columns count on.
  int first_column = 0, first_row = 0;
  int columns = 0, rows = 0;   ///< may be 0: nothing of the raster is requested
  std::vector<double> values;  ///< index row * columns + column
};

/// Where the nodes of a local grid fall in a raster: pixel coordinates, (0.5, 0.5) being
/// the middle of the first pixel. Computed exactly on a coarse lattice, at most 250 m
/// apart, and bilinear within: the curvature left out is below 2 mm.
class PixelMap {
 public:
  /// The grid on which results are requested.
  const GridShape& shape() const { return shape_; }
  /// The pixels that bilinear sampling of the grid needs, within the raster; see
  /// PixelWindow for its seam.
  const PixelWindow& window() const { return window_; }
  /// (column, row) in the raster of a node.
  Vec2 pixel(int row, int column) const;
  /// Direction in the local frame [rad] in which a component of the given kind points: of
  /// the raster's own "up" (grid north), or of the meridian (true north), at a node.
  double grid_north(int row, int column) const;
  double true_north(int row, int column) const;

 private:
  friend Result<PixelMap> map_pixels(const Georeference&, const geo::LocalFrame&,
                                     const GridShape&, const std::string&);
  struct Knot {
    Vec2 pixel;
    Vec2 grid_north, true_north;  // unit vectors in the local frame
  };
  Knot knot_mix(int row, int column) const;
  void count_on();

  GridShape shape_;
  PixelWindow window_;
  int raster_columns_ = 0, raster_rows_ = 0;
  int step_ = 1;  // nodes between knots
  int knot_columns_ = 0;
  std::vector<Knot> knots_;
  friend Result<GridField> resample(const PixelWindow&, const PixelMap&, Missing,
                                    const std::string&);
};

/// @param path  of the raster, named in the error.
/// Fails: kBadInput when the area cannot be projected into the raster's system.
Result<PixelMap> map_pixels(const Georeference& raster, const geo::LocalFrame& frame,
                            const GridShape& shape, const std::string& path);

/// Pixels brought onto a local grid by bilinear interpolation between pixel centres; a
/// node has a value when it lies within a pixel that has one, and neighbours without are
/// left out of the mean.
/// @param place  named in the error.
/// Fails: kBadInput when nodes have no value and `missing` forbids it, or none has one.
Result<GridField> resample(const PixelWindow& pixels, const PixelMap& map,
                           Missing missing, const std::string& place);

}  // namespace skein::environment
