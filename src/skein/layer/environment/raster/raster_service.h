// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/base/service_process.h"
#include "skein/layer/environment/raster/pixel_map.h"
#include "skein/layer/environment/raster/raster_facts.h"

namespace skein::environment {

/// A raster that is opened and read in a process of its own. The libraries behind GDAL
/// (netCDF, HDF5, those of GRIB...) crash on some damaged files; here that is an error.
class RasterService {
 public:
  /// Fails: as RasterFile::open().
  static Result<RasterService> start(const std::string& path,
                                     const std::string& variable);

  const RasterFacts& facts() const { return facts_; }
  /// As RasterFile::read(); the band exists and the window lies within the raster.
  Result<PixelWindow> read(int band, const PixelWindow& window);

 private:
  RasterService(std::string path, ServiceProcess process)
      : path_(std::move(path)), process_(std::move(process)) {}
  Result<ServiceMessage> ask(const ServiceMessage& request);

  std::string path_;
  ServiceProcess process_;
  RasterFacts facts_;
};

}  // namespace skein::environment
