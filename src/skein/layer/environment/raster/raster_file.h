// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/geo/local_frame.h"
#include "skein/layer/environment/raster/pixel_map.h"
#include "skein/layer/environment/raster/raster_facts.h"

namespace skein::environment {

/// A raster (GeoTIFF, NetCDF, GRIB, ASCII grid...; docs/environment.md has all formats),
/// opened for reading, with its place on the Earth. One object is for one thread at a
/// time.
///
/// The file is opened and read in a process of its own (RasterService): one on which its
/// library crashes is an error like any other.
class RasterFile {
 public:
  /// @param variable  name of the variable, for files with several (NetCDF); else empty.
  /// Fails: kNotFound when there is no such file or variable (the message lists those
  ///        there are); kBadInput when GDAL cannot read it or crashes, it is truncated
  ///        (check_whole()), or it is not georeferenced; kUnavailable when no process
  ///        can be made.
  static Result<RasterFile> open(const std::string& path,
                                 const std::string& variable = "");

  RasterFile(RasterFile&&) noexcept;
  RasterFile& operator=(RasterFile&&) noexcept;
  ~RasterFile();

  const std::string& path() const { return path_; }
  const std::vector<BandInfo>& bands() const;
  int columns() const;
  int rows() const;
  /// Whether the raster's axes are latitude and longitude.
  bool geographic() const;

  /// One unit of the heights of its vertical reference system [m]; none when it has no
  /// such system. Negative where that counts downwards.
  std::optional<double> vertical_unit() const;

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
  /// A window may reach over the seam of a raster that goes once around the Earth.
  Result<PixelWindow> read(int band, const PixelWindow& window) const;

 private:
  Result<PixelWindow> read_around(int band, const PixelWindow& window) const;
  struct Handles;
  RasterFile(std::string path, std::unique_ptr<Handles> handles);
  Error error(const std::string& message, const std::string& hint = "") const;
  Result<void> georeference();

  std::string path_;
  std::unique_ptr<Handles> handles_;
};

/// Opens, maps, reads and resamples one band in one go.
Result<GridField> read_grid(const std::string& path, int band, const std::string& name,
                            const geo::LocalFrame& frame, const GridShape& shape,
                            Missing missing);

}  // namespace skein::environment
