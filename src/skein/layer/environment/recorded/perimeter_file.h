// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/layer/environment/raster/date_time.h"
#include "skein/layer/environment/recorded/perimeter.h"

namespace skein::environment {

/// What reading perimeters gave.
struct RawSeries {
  std::vector<RawPerimeter> perimeters;  ///< in the order of the file; degrees
  bool utc = false;  ///< times are seconds since 1970 UTC, not from an unknown origin
};

/// What a source does not say of itself.
struct PerimeterFileOptions {
  std::string time_field =
      {};  ///< attribute or column with the time; empty: it is looked for
  std::string incident = {};  ///< name of the fire, of those that a source holds
  double utc_offset_h = 0;    ///< local time minus UTC of times without a zone [h]
  std::optional<DateOrder> date_order = {};  ///< of dates; none: the one that they show
};

/// Reads the outlines of a fire with their times, in any vector format of
/// docs/environment.md.
///
/// `path` is one of
/// - a vector file (GeoJSON, shapefile, zipped too, KML, KMZ, GeoPackage, file
///   geodatabase...) whose features have times, see dated_perimeters();
/// - a CSV table, one row per perimeter: a column of time, and the column `file`
///   (relative to the table), or the columns n and object_id, which name
///   `<table without .csv>/<n, two digits>_<object_id>.shp`;
/// - a folder that holds perimeters.csv, or else vector files, all of one fire.
///
/// Geometry that is no area and no line is left out; that and all that is assumed is
/// reported in `warnings`.
/// Fails: kNotFound for what is missing; kBadInput: not readable, no coordinate system,
///        no time, coordinates that are not finite or no latitude and longitude, over
///        five million points.
Result<RawSeries> read_perimeters(const std::string& path,
                                  const PerimeterFileOptions& options,
                                  std::vector<std::string>& warnings);

/// Whether a path ends like that of a vector dataset which can be read.
bool is_vector_name(const std::filesystem::path& path);

/// As above, for one vector dataset by its GDAL name (which may be in memory).
Result<RawSeries> read_vector(const std::string& name,
                              const PerimeterFileOptions& options,
                              std::vector<std::string>& warnings);

}  // namespace skein::environment
