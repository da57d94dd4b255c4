// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/base/result.h"
#include "skein/geo/gdal/gdal_handles.h"
#include "skein/layer/environment/raster/pixel_map.h"
#include "skein/layer/environment/raster/raster_facts.h"

namespace skein::environment {

/// A raster opened with GDAL in this process: what a RasterService does.
class RasterSource {
 public:
  /// As RasterFile::open().
  static Result<RasterSource> open(const std::string& path, const std::string& variable);

  const RasterFacts& facts() const { return facts_; }

  /// As RasterFile::read(); the band exists and the window lies within the raster.
  Result<PixelWindow> read(int band, const PixelWindow& window) const;

 private:
  explicit RasterSource(std::string path) : path_(std::move(path)) {}
  Result<void> choose(const std::string& variable);
  Result<void> look();
  Error error(const std::string& message, const std::string& hint = "") const {
    return {ErrorCode::kBadInput, path_, message, hint};
  }

  std::string path_;
  geo::GdalDataset dataset_;
  RasterFacts facts_;
};

}  // namespace skein::environment
