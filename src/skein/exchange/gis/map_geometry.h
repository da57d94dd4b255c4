// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/result.h"
#include "skein/exchange/gis/map_features.h"

namespace skein::exchange {

/// Makes one area of the areas among the parts of one feature where they touch and do not
/// overlap, as those do into which RFC 7946 cuts an area at 180 degrees. Leaves all as it
/// is where they do not make up one area.
void join_touching_areas(std::vector<MapFeature>& parts);

/// Makes one line of those among the parts of one feature each of which ends where the
/// next begins, at 180 degrees of longitude, where RFC 7946 cuts lines.
void join_cut_lines(std::vector<MapFeature>& parts, const geo::LocalFrame& frame);

/// Takes a geometry of GDAL apart into features that have the properties of `common`.
class GeometryReader {
 public:
  /// @param frame       null: coordinates are metres to east and north.
  /// @param to_degrees  an OGRCoordinateTransformationH; not used for metres.
  /// @param points      counts those of all geometries of a file.
  GeometryReader(const MapFeature& common, const geo::LocalFrame* frame, void* to_degrees,
                 std::size_t& points)
      : common_(common), frame_(frame), to_degrees_(to_degrees), points_(points) {}

  /// @param geometry  an OGRGeometryH, or null.
  /// Fails: see read_map().
  Result<void> read(void* geometry, int depth = 0);

  std::vector<MapFeature>& features() { return features_; }
  int clockwise() const { return clockwise_; }  ///< outer rings that ran so on the map

 private:
  Error error(const std::string& message, const std::string& hint = "") const;
  Result<void> read_parts(void* geometry, int depth);
  Result<void> read_curves(void* geometry, int depth);
  Result<void> read_polygon(void* geometry);
  Result<void> add(MapFeature::Kind kind, void* geometry);
  Result<std::vector<Vec2>> points_of(void* line);
  Result<Vec2> in_plane(double x, double y, int number) const;
  Result<geo::Ring> ring_of(void* line, bool outer);

  const MapFeature& common_;
  const geo::LocalFrame* frame_;
  void* to_degrees_;
  std::size_t& points_;
  std::vector<MapFeature> features_;
  int clockwise_ = 0;
};

}  // namespace skein::exchange
