#pragma once

#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/layer/environment/recorded/perimeter.h"

namespace skein::environment {

/// What reading perimeters gave.
struct RawSeries {
  std::vector<RawPerimeter> perimeters;  ///< in the order of the file; degrees
  bool utc = false;  ///< times are seconds since 1970 UTC, not from an unknown origin
};

/// Reads the outlines of a fire with their times, in any vector format of
/// docs/environment.md.
///
/// `path` is one of
/// - a vector file (GeoJSON, shapefile, KML, GeoPackage...) whose features carry a time:
///   the attribute `time_field`, or else the first there is of seconds, time_s, time_utc,
///   time_local, time, datetime, timestamp, date; a number counts as seconds, a date and
///   time as ISO 8601 (UTC when it has no zone);
/// - a CSV table, one row per perimeter: a column of time by the same names, and the
/// column
///   `file` (relative to the table), or the columns n and object_id, which name
///   `<table without .csv>/<n, two digits>_<object_id>.shp`;
/// - a folder that holds perimeters.csv, or else exactly one vector file.
///
/// Geometry that is no area and no line is left out and reported in `warnings`.
/// Fails: kNotFound for what is missing; kBadInput: not readable, no coordinate system,
/// no
///        time, coordinates that are not finite or no latitude and longitude, over five
///        million points.
Result<RawSeries> read_perimeters(const std::string& path, const std::string& time_field,
                                  std::vector<std::string>& warnings);

/// As above, for one vector dataset by its GDAL name (which may be in memory).
Result<RawSeries> read_vector(const std::string& name, const std::string& time_field,
                              std::vector<std::string>& warnings);

}  // namespace skein::environment
