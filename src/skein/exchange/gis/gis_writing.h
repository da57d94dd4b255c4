// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "skein/base/result.h"
#include "skein/geo/local_frame.h"
#include "skein/geo/polygon.h"

namespace skein::exchange {

/// One shape with its fields, as a geographic information system takes it.
struct GisFeature {
  enum class Kind { kLine, kArea };
  Kind kind = Kind::kArea;
  /// The points of a line; or a clean region (geo/clip.h): outer rings positive, holes
  /// negative, as many parts as it has.
  std::vector<geo::Ring> rings;
  /// Name and value, the same names in the same order in all features of a file. Names of
  /// at most 10 letters, digits and underscores survive in shapefiles too. A number that
  /// is not finite is left out: null.
  std::vector<std::pair<std::string, std::variant<double, std::string>>> fields;
};

/// Writes features in degrees of WGS 84: GeoJSON (.geojson), KML (.kml), GeoPackage
/// (.gpkg) or shapefile (.shp with its companions), by the file's ending. What stood
/// there is replaced only when everything is written. Lines and areas that cross 180
/// degrees of longitude are cut there (geo/antimeridian.h).
/// @param layer  name of the features, for formats that have layers.
/// Fails: kBadInput for another ending; kUnavailable when it cannot be written.
Result<void> write_gis(const std::vector<GisFeature>& features, const std::string& layer,
                       const geo::LocalFrame& frame, const std::filesystem::path& file);

/// The same, not written but as the bytes of the file.
/// @param ending  .geojson, .kml, .gpkg, or .shp.zip: a shapefile packed with its
///                companions.
/// Fails: as write_gis().
Result<std::string> gis_bytes(const std::vector<GisFeature>& features,
                              const std::string& layer, const geo::LocalFrame& frame,
                              const std::string& ending);

}  // namespace skein::exchange
