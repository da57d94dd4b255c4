// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/gis/zones.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string_view>

#include "skein/geo/clip.h"
#include "skein/geo/self_crossing.h"

namespace skein::exchange {
namespace {

constexpr double kOverlap = 0.1;  // of each part of a zone that was cut [m]

Error refused(const MapFeature& feature, const std::string& message,
              const std::string& hint = "") {
  return {ErrorCode::kBadInput, feature.place, message, hint};
}

// Whether a feature says that it is something else: by `what` of Skein's own files, or by
// its purpose, of which there may be none.
bool is_other(const MapFeature& feature, const char* what,
              std::initializer_list<std::string_view> purposes) {
  if (!feature.what.empty() && feature.what != what) return true;
  return !feature.purpose.empty() &&
         std::find(purposes.begin(), purposes.end(), feature.purpose) == purposes.end();
}

std::optional<double> number(const MapFeature& feature, const char* key) {
  const auto found = feature.numbers.find(key);
  if (found == feature.numbers.end()) return std::nullopt;
  return found->second;
}

Result<void> check_rings(const MapFeature& feature) {
  std::vector<const geo::Ring*> rings = {&feature.points};
  for (const geo::Ring& hole : feature.holes) rings.push_back(&hole);
  for (const geo::Ring* ring : rings)
    if (const auto crossing = geo::self_crossing(*ring))
      return refused(
          feature,
          fmt::format("its ring crosses itself {:.1f} m north and {:.1f} m east "
                      "of the origin; rings without crossings are allowed.",
                      crossing->point.x(), crossing->point.y()),
          "Give the parts as areas of their own.");
  return {};
}

Result<Zone> limits_of(const MapFeature& feature) {
  Zone zone;
  zone.name = feature.name;
  zone.floor_msl = number(feature, "floor_m").value_or(zone.floor_msl);
  zone.ceiling_msl = number(feature, "ceiling_m").value_or(zone.ceiling_msl);
  zone.from = number(feature, "from_s").value_or(zone.from);
  zone.until = number(feature, "until_s").value_or(zone.until);
  if (zone.floor_msl > zone.ceiling_msl)
    return refused(feature, fmt::format("floor_m {} is above ceiling_m {}.",
                                        zone.floor_msl, zone.ceiling_msl));
  if (zone.from > zone.until)
    return refused(feature,
                   fmt::format("from_s {} is after until_s {}.", zone.from, zone.until));
  return zone;
}

// Rings without holes that cover a clean region: it is cut through the holes.
void cut_through_holes(const geo::Region& region, std::vector<geo::Ring>& out) {
  const auto hole = std::find_if(region.begin(), region.end(), [](const geo::Ring& ring) {
    return geo::signed_area(ring) < 0;
  });
  if (hole == region.end()) {
    out.insert(out.end(), region.begin(), region.end());
    return;
  }
  double south = hole->front().x(), north = south;
  for (const Vec2& p : *hole) {
    south = std::min(south, p.x());
    north = std::max(north, p.x());
  }
  const double middle = (south + north) / 2, far = 3e6;  // beyond what maps may hold
  const auto band = [&](double low, double high) {
    return geo::Region{{{low, -far}, {high, -far}, {high, far}, {low, far}}};
  };
  cut_through_holes(geo::intersect(region, band(middle - kOverlap, far)), out);
  cut_through_holes(geo::intersect(region, band(-far, middle + kOverlap)), out);
}

Result<void> add_area(const MapFeature& feature, const Zone& limits,
                      std::vector<Zone>& zones) {
  if (auto good = check_rings(feature); !good) return good;
  std::vector<geo::Ring> rings = {feature.points};
  if (!feature.holes.empty()) {
    geo::Region holes;
    for (const geo::Ring& hole : feature.holes) holes.push_back(hole);
    rings.clear();
    cut_through_holes(
        geo::subtract({feature.points}, geo::clean(holes, geo::FillRule::kNonZero)),
        rings);
    if (rings.empty()) return refused(feature, "its holes leave nothing of the area.");
  }
  for (geo::Ring& ring : rings) {
    Zone zone = limits;
    zone.area = std::move(ring);
    zones.push_back(std::move(zone));
  }
  return {};
}

Result<Disc> disc_of(const MapFeature& feature) {
  const auto radius = number(feature, "radius_m");
  if (!radius || !(*radius > 0) || *radius > 1e6)
    return refused(
        feature,
        radius ? fmt::format("radius_m is {}; above 0 to 1e6 is allowed.", *radius)
               : "is a point without radius_m.",
        "A point with radius_m is a disc.");
  return Disc{feature.points[0], *radius};
}

}  // namespace

Result<std::vector<Zone>> zones_of(const std::vector<MapFeature>& features) {
  std::vector<Zone> zones;
  for (const MapFeature& feature : features) {
    if (is_other(feature, "zone", {"exclusion"})) continue;
    if (feature.kind == MapFeature::Kind::kLine)
      return refused(feature,
                     "is a line, which is no zone; areas and points with radius_m are.");
    auto limits = limits_of(feature);
    if (!limits) return limits.error();
    if (feature.kind == MapFeature::Kind::kArea) {
      if (auto good = add_area(feature, limits.value(), zones); !good)
        return good.error();
      continue;
    }
    const auto disc = disc_of(feature);
    if (!disc) return disc.error();
    limits.value().area = disc.value();
    zones.push_back(std::move(limits).value());
  }
  return zones;
}

int movers_among_zones(const std::vector<MapFeature>& features) {
  constexpr const char* kOfMovers[] = {"height_m", "time_s", "climb_mps",
                                       "velocity_east_mps", "velocity_north_mps"};
  return static_cast<int>(
      std::count_if(features.begin(), features.end(), [&](const MapFeature& feature) {
        return !is_other(feature, "zone", {"exclusion"}) &&
               std::any_of(
                   std::begin(kOfMovers), std::end(kOfMovers),
                   [&](const char* key) { return feature.numbers.contains(key); });
      }));
}

Result<MapFeature> area_of(const std::vector<MapFeature>& features) {
  const MapFeature* area = nullptr;
  for (const MapFeature& feature : features) {
    if (is_other(feature, "area", {"survey"}) || feature.kind != MapFeature::Kind::kArea)
      continue;
    if (area != nullptr)
      return refused(feature, fmt::format("is a second area after {}; one is allowed.",
                                          area->place));
    area = &feature;
  }
  if (area == nullptr)
    return Error{ErrorCode::kBadInput,
                 features.empty() ? std::string() : features.front().place,
                 "is no area, and no other feature is.", "One area is needed."};
  if (auto good = check_rings(*area); !good) return good.error();
  return *area;
}

Result<MapFeature> line_of(const std::vector<MapFeature>& features) {
  const MapFeature* line = nullptr;
  for (const MapFeature& feature : features) {
    if (is_other(feature, "line", {"route", "corridor"}) ||
        feature.kind != MapFeature::Kind::kLine)
      continue;
    if (line != nullptr)
      return refused(feature, fmt::format("is a second line after {}; one is allowed.",
                                          line->place));
    line = &feature;
  }
  if (line != nullptr) return *line;
  auto rim = area_of(features);
  if (!rim) {
    Error error = rim.error();
    error.hint = "One line, or one area whose rim is meant, is needed.";
    return error;
  }
  rim.value().points.push_back(rim.value().points.front());
  rim.value().kind = MapFeature::Kind::kLine;
  return rim;
}

Result<std::vector<MovingObstacle>> movers_of(const std::vector<MapFeature>& features) {
  std::vector<MovingObstacle> movers;
  for (const MapFeature& feature : features) {
    if (is_other(feature, "obstacle", {})) continue;
    if (feature.kind != MapFeature::Kind::kPoint)
      return refused(feature, "is no point; moving obstacles are.");
    const auto altitude = number(feature, "altitude_m");
    const auto radius = number(feature, "radius_m"), height = number(feature, "height_m");
    for (const auto& [key, value] :
         {std::pair{"radius_m", radius}, std::pair{"height_m", height}})
      if (!value || !(*value > 0))
        return refused(feature,
                       value ? fmt::format("{} is {}; above 0 is allowed.", key, *value)
                             : fmt::format("has no {}.", key));
    if (!altitude && !feature.altitude)
      return refused(feature, "has no altitude.",
                     "Give a third coordinate or altitude_m.");
    if (!altitude && !feature.altitude_is_msl)
      return refused(feature, "its altitude is not one above the sea (altitudeMode).",
                     "Give altitude_m, or altitudeMode absolute.");
    MovingObstacle m;
    m.time = number(feature, "time_s").value_or(0);
    const Vec2& p = feature.points[0];
    m.p_N = {p.x(), p.y(), -(altitude ? *altitude : *feature.altitude)};
    m.v_N = {number(feature, "velocity_north_mps").value_or(0),
             number(feature, "velocity_east_mps").value_or(0),
             -number(feature, "climb_mps").value_or(0)};
    m.radius = *radius;
    m.height = *height;
    m.from = number(feature, "from_s").value_or(m.from);
    m.until = number(feature, "until_s").value_or(m.until);
    if (m.from > m.until)
      return refused(feature,
                     fmt::format("from_s {} is after until_s {}.", m.from, m.until));
    movers.push_back(m);
  }
  return movers;
}

}  // namespace skein::exchange
