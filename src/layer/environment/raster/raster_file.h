#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "geo/local_frame.h"
#include "layer/environment/raster/grid_field.h"

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

/// What to do with nodes of the wanted grid for which the raster has no value.
enum class Missing {
  kError,    ///< refuse
  kNearest,  ///< take the value of the nearest node that has one
  kKeep,     ///< leave NaN
};

/// A rectangle of pixels, values unpacked (scale * stored + offset); NaN where the file
/// declares that there is no value.
struct PixelWindow {
  int first_column = 0, first_row = 0;  ///< in the raster
  int columns = 0, rows = 0;            ///< may be 0: nothing of the raster is wanted
  std::vector<double> values;           ///< index row * columns + column
};

/// Where the nodes of a local grid fall in a raster: pixel coordinates, (0.5, 0.5) being
/// the middle of the first pixel. Computed exactly on a coarse lattice, at most 250 m
/// apart, and bilinear within: the curvature left out is below 2 mm.
class PixelMap {
 public:
  /// The grid on which results are wanted.
  const GridShape& shape() const { return shape_; }
  /// The pixels that bilinear sampling of the grid needs, within the raster.
  const PixelWindow& window() const { return window_; }
  /// (column, row) in the raster of a node.
  Vec2 pixel(int row, int column) const;
  /// Direction in the local frame [rad] in which a component of the given kind points: of
  /// the raster's own "up" (grid north), or of the meridian (true north), at a node.
  double grid_north(int row, int column) const;
  double true_north(int row, int column) const;

 private:
  friend class RasterFile;
  struct Knot {
    Vec2 pixel;
    Vec2 grid_north, true_north;  // unit vectors in the local frame
  };
  Knot knot_mix(int row, int column) const;

  GridShape shape_;
  PixelWindow window_;
  int raster_columns_ = 0, raster_rows_ = 0;
  int step_ = 1;  // nodes between knots
  int knot_columns_ = 0;
  std::vector<Knot> knots_;
  friend Result<GridField> resample(const PixelWindow&, const PixelMap&, Missing,
                                    const std::string&);
};

/// Any raster that GDAL reads (GeoTIFF, NetCDF, GRIB, ASCII grid...), opened for reading,
/// with its place on the Earth. One object is for one thread at a time.
class RasterFile {
 public:
  /// @param variable  name of the variable, for files with several (NetCDF); else empty.
  /// Fails: kNotFound when there is no such file or variable (the message lists those
  ///        there are); kBadInput when GDAL cannot read it, or it is not georeferenced.
  static Result<RasterFile> open(const std::string& path,
                                 const std::string& variable = "");

  RasterFile(RasterFile&&) noexcept;
  RasterFile& operator=(RasterFile&&) noexcept;
  ~RasterFile();

  const std::string& path() const { return path_; }
  const std::vector<BandInfo>& bands() const { return bands_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  /// Whether the raster's axes are latitude and longitude.
  bool geographic() const { return geographic_; }

  /// The band with this number, or, when `name` is not empty, the only one of this name.
  /// Fails: kNotFound with the names there are.
  Result<int> find_band(int number, const std::string& name) const;

  /// Geodetic position of a pixel coordinate, height 0. Fails: kBadInput when the
  /// raster's projection has no inverse there.
  Result<geo::Geodetic> geodetic(const Vec2& pixel) const;

  /// Size of a pixel on the ground at the local frame's origin, the smaller side [m].
  Result<double> pixel_size(const geo::LocalFrame& frame) const;

  /// Fails: kBadInput when the area cannot be projected into the raster's system.
  Result<PixelMap> map(const geo::LocalFrame& frame, const GridShape& shape) const;

  /// Reads pixels. Fails: kBadInput when the file is truncated or corrupt, or holds a
  /// value that is not finite and is not declared as "no value".
  Result<PixelWindow> read(int band, const PixelWindow& window) const;

 private:
  struct Handles;
  RasterFile(std::string path, std::unique_ptr<Handles> handles);
  Error fault(const std::string& message, const std::string& hint = "") const;
  void describe_bands();

  std::string path_;
  std::unique_ptr<Handles> handles_;
  std::vector<BandInfo> bands_;
  int columns_ = 0, rows_ = 0;
  bool geographic_ = false;
};

/// Pixels brought onto a local grid by bilinear interpolation between pixel centres; a
/// node has a value when it lies within a pixel that has one, and neighbours without are
/// left out of the mean.
/// @param place  named in the error.
/// Fails: kBadInput when nodes have no value and `missing` forbids it, or none has one.
Result<GridField> resample(const PixelWindow& pixels, const PixelMap& map,
                           Missing missing, const std::string& place);

/// Opens, maps, reads and resamples one band in one go.
Result<GridField> read_grid(const std::string& path, int band, const std::string& name,
                            const geo::LocalFrame& frame, const GridShape& shape,
                            Missing missing);

}  // namespace skein::environment
