// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/gis/map_geometry.h"

#include <fmt/format.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "skein/geo/clip.h"
#include "skein/geo/place_limits.h"

namespace skein::exchange {
namespace {

constexpr std::size_t kMaxPoints = 1'000'000;  // of a file
constexpr std::size_t kMaxInRing =
    20'000;                            // asking whether it crosses itself is quadratic
constexpr int kDeepest = 16;           // collections within each other
constexpr std::size_t kMaxJoined = 8;  // parts of one area
constexpr std::size_t kMaxJoinedPoints = 2000;  // joining is quadratic in them
constexpr double kSameArea = 1e-5;              // of areas joined and alone, relative
constexpr double kMinArea = 0.01;               // of a ring [m^2]

struct DestroyGeometry {
  void operator()(void* geometry) const {
    OGR_G_DestroyGeometry(static_cast<OGRGeometryH>(geometry));
  }
};

}  // namespace

void join_touching_areas(std::vector<MapFeature>& parts) {
  if (parts.size() < 2 || parts.size() > kMaxJoined) return;
  geo::Region whole;
  double total = 0;
  std::size_t points = 0;
  for (const MapFeature& part : parts) {
    points += part.points.size();
    for (const geo::Ring& hole : part.holes) points += hole.size();
    if (part.kind != MapFeature::Kind::kArea || points > kMaxJoinedPoints) return;
    geo::Region area = {part.points};
    if (!part.holes.empty()) area = geo::subtract(area, part.holes);
    total += geo::area(area);
    whole = whole.empty() ? area : geo::unite(whole, area);
  }
  MapFeature joined = parts.front();
  joined.points.clear();
  joined.holes.clear();
  for (geo::Ring& ring : whole) {
    if (geo::signed_area(ring) < 0) {
      std::reverse(ring.begin(), ring.end());
      joined.holes.push_back(std::move(ring));
    } else if (joined.points.empty()) {
      joined.points = std::move(ring);
    } else {
      return;  // apart
    }
  }
  double left = joined.points.empty() ? 0 : geo::signed_area(joined.points);
  for (const geo::Ring& hole : joined.holes) left -= geo::signed_area(hole);
  // What overlaps, or crosses itself, is said where areas are used.
  if (std::abs(left - total) > kSameArea * total) return;
  parts = {std::move(joined)};
}

void join_cut_lines(std::vector<MapFeature>& parts, const geo::LocalFrame& frame) {
  constexpr double kSamePlace = 0.001;  // [m]
  constexpr double kOnIt = 1e-8;        // of longitude [deg]
  const auto join = [&](MapFeature& line, const MapFeature& next) {
    if (line.kind != MapFeature::Kind::kLine || next.kind != MapFeature::Kind::kLine)
      return false;
    const Vec2 end = line.points.back();
    if ((next.points.front() - end).norm() > kSamePlace ||
        180 - std::abs(frame.from_plane(end).longitude_deg) > kOnIt)
      return false;
    line.points.insert(line.points.end(), next.points.begin() + 1, next.points.end());
    return true;
  };
  std::vector<MapFeature> joined;
  for (MapFeature& each : parts)
    if (joined.empty() || !join(joined.back(), each)) joined.push_back(std::move(each));
  parts = std::move(joined);
}

Error GeometryReader::error(const std::string& message, const std::string& hint) const {
  return {ErrorCode::kBadInput, common_.place, message, hint};
}

Result<void> GeometryReader::read(void* geometry, int depth) {
  if (geometry == nullptr || OGR_G_IsEmpty(geometry) != 0)
    return error("has an empty geometry; points, lines and areas are allowed.");
  if (depth > kDeepest) return error("has collections nested too deeply.");
  switch (wkbFlatten(OGR_G_GetGeometryType(geometry))) {
    case wkbPoint:
      return add(MapFeature::Kind::kPoint, geometry);
    case wkbLineString:
      return add(MapFeature::Kind::kLine, geometry);
    case wkbPolygon:
    case wkbTriangle:
      return read_polygon(geometry);
    case wkbMultiPoint:
    case wkbMultiLineString:
    case wkbMultiPolygon:
    case wkbGeometryCollection:
      return read_parts(geometry, depth);
    default:
      return read_curves(geometry, depth);
  }
}

Result<void> GeometryReader::read_parts(void* geometry, int depth) {
  for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i)
    if (auto good = read(OGR_G_GetGeometryRef(geometry, i), depth + 1); !good)
      return good;
  return {};
}

// Arcs become chords of 4 degrees, the library's default.
Result<void> GeometryReader::read_curves(void* geometry, int depth) {
  const std::unique_ptr<void, DestroyGeometry> straight(
      OGR_G_GetLinearGeometry(geometry, 0, nullptr));
  if (!straight || OGR_G_HasCurveGeometry(straight.get(), TRUE) != 0 ||
      OGR_G_GetGeometryType(straight.get()) == OGR_G_GetGeometryType(geometry))
    return error(
        fmt::format("has a geometry of the kind {}; points, lines and areas are "
                    "allowed.",
                    OGR_G_GetGeometryName(geometry)));
  return read(straight.get(), depth + 1);
}

Result<void> GeometryReader::read_polygon(void* geometry) {
  MapFeature feature = common_;
  feature.kind = MapFeature::Kind::kArea;
  for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i) {
    void* const line = OGR_G_GetGeometryRef(geometry, i);
    auto ring = ring_of(line, i == 0);
    if (!ring) return ring.error();
    if (i > 0) {
      feature.holes.push_back(std::move(ring).value());
      continue;
    }
    feature.points = std::move(ring).value();
    if (OGR_G_Is3D(line) != 0) feature.altitude = OGR_G_GetZ(line, 0);
  }
  features_.push_back(std::move(feature));
  return {};
}

Result<void> GeometryReader::add(MapFeature::Kind kind, void* geometry) {
  auto points = points_of(geometry);
  if (!points) return points.error();
  MapFeature feature = common_;
  feature.kind = kind;
  feature.points = std::move(points).value();
  if (kind == MapFeature::Kind::kLine && feature.points.size() < 2)
    return error("is a line of fewer than two different points.");
  if (OGR_G_Is3D(geometry) != 0) feature.altitude = OGR_G_GetZ(geometry, 0);
  if (feature.altitude && !std::isfinite(*feature.altitude))
    return error(fmt::format("has the altitude {}; a finite number is allowed.",
                             *feature.altitude));
  features_.push_back(std::move(feature));
  return {};
}

Result<geo::Ring> GeometryReader::ring_of(void* line, bool outer) {
  auto points = points_of(line);
  if (!points) return points.error();
  geo::Ring ring = std::move(points).value();
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  if (ring.size() > kMaxInRing)
    return error(fmt::format("has a ring of {} points; at most {} are allowed.",
                             ring.size(), kMaxInRing),
                 "Simplify it.");
  if (ring.size() < 3)
    return error(fmt::format("has a ring of {} different points; at least 3 are needed.",
                             ring.size()));
  double total = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    total +=
        std::abs(geo::cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]));
  if (total / 2 < kMinArea)
    return error("has a ring without an area: all its points lie on one line.");
  // Whether a ring that crosses itself is positive is a matter of taste; it is refused
  // where areas are used.
  if (geo::signed_area(ring) < 0)
    std::reverse(ring.begin(), ring.end());
  else if (outer)
    ++clockwise_;
  return ring;
}

Result<std::vector<Vec2>> GeometryReader::points_of(void* line) {
  const int count = line == nullptr ? 0 : OGR_G_GetPointCount(line);
  points_ += static_cast<std::size_t>(count);
  if (points_ > kMaxPoints)
    return error(
        fmt::format("takes the file over {} points, the maximum allowed.", kMaxPoints));
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const auto p = in_plane(OGR_G_GetX(line, i), OGR_G_GetY(line, i), i);
    if (!p) return p.error();
    if (points.empty() || points.back() != p.value()) points.push_back(p.value());
  }
  return points;
}

Result<Vec2> GeometryReader::in_plane(double x, double y, int number) const {
  if (!std::isfinite(x) || !std::isfinite(y))
    return error(
        fmt::format("its point {} is {}, {}; finite numbers are allowed.", number, x, y));
  Vec2 p(y, x);
  double distance = p.norm();
  if (frame_ != nullptr) {
    double longitude = x, latitude = y;
    int good = 1;
    OCTTransformEx(static_cast<OGRCoordinateTransformationH>(to_degrees_), 1, &longitude,
                   &latitude, nullptr, &good);
    if (good == 0 || !(std::abs(latitude) <= 90) || !(std::abs(longitude) <= 360))
      return error(fmt::format("its point {} ({}, {}) has no longitude and latitude: "
                               "within -360 to 360 and -90 to 90 are allowed.",
                               number, x, y),
                   "The longitude comes first.");
    p = frame_->to_plane(latitude, longitude);
    distance = geo::distance_from_origin(*frame_, latitude, longitude);
  }
  if (!(distance <= geo::kMaxPlaceDistance))
    return error(
        fmt::format(
            "its point {} ({}, {}) lies {:.0f} km from the origin; at most {:.0f} "
            "km are allowed.",
            number, x, y, distance / 1000, geo::kMaxPlaceDistance / 1000),
        frame_ != nullptr ? "The longitude comes first; is the origin right?"
                          : "Are the coordinates metres?");
  return p;
}

}  // namespace skein::exchange
