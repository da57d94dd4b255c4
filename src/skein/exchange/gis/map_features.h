// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/geo/local_frame.h"
#include "skein/geo/polygon.h"

namespace skein::exchange {

/// One shape of a map file in the local plane, with the properties that plans know.
struct MapFeature {
  enum class Kind { kPoint, kLine, kArea };
  Kind kind = Kind::kPoint;
  std::string place;  ///< for messages: "zones.geojson: feature 3"
  std::string name;   ///< property `name`; may be empty
  std::string what;   ///< property `what` of files that Skein wrote; may be empty
  /// What it is for, by a .plan or the property `purpose`: a fence of "inclusion" or
  /// "exclusion", a "survey", "corridor", "route", "waypoint" or "rally" point; empty: it
  /// does not say.
  std::string purpose;
  /// The point, the line, or the area's outer ring, positive and without a repeated end.
  std::vector<Vec2> points;
  std::vector<geo::Ring> holes;    ///< of an area, positive
  std::optional<double> altitude;  ///< third coordinate of the first point [m]
  /// Whether `altitude` may be taken as above the sea; false where a KML file says that
  /// it is above the ground, or means nothing.
  bool altitude_is_msl = true;
  std::map<std::string, double> numbers;  ///< known_properties() that it has, finite
};

/// The numbers that are read of a feature: floor_m, ceiling_m, from_s, until_s, radius_m
/// and those of moving obstacles.
const std::vector<std::string>& known_properties();

/// Reads all features of all layers of a map file: GeoJSON, KML, QGroundControl's .plan
/// (see read_ground_plan()), or any vector format that GDAL reads, in an archive too.
/// Tables without geometry are passed over. What has several parts becomes several
/// features with one place. Rings may run in either sense; points that repeat the one
/// before are left out.
///
/// @param frame     the plane; null: coordinates are metres to east and north already
///                  (not in KML).
/// @param warnings  gets a line for each kind of oddity: rings that run against the
///                  format's rule, properties that look like known ones without a unit.
/// Fails: kNotFound for a file that is not there; kBadInput for one that is no map, has
///        an empty geometry, coordinates that are not finite or out of range or
///        more than 1000 km away, rings without an area or of over 20000 points, a
///        property that is no number. The message has file, feature (from 0) and what is
///        allowed.
Result<std::vector<MapFeature>> read_map(const std::string& file,
                                         const geo::LocalFrame* frame,
                                         std::vector<std::string>& warnings);

/// The same of what somebody sent: GeoJSON, KML or .plan, by its first characters. No
/// other reader sees it.
/// @param name  of the file, for messages.
Result<std::vector<MapFeature>> read_map_text(std::string_view text,
                                              const std::string& name,
                                              const geo::LocalFrame& frame,
                                              std::vector<std::string>& warnings);

}  // namespace skein::exchange
