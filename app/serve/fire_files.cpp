// SPDX-License-Identifier: Apache-2.0
#include "app/serve/fire_files.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "skein/exchange/gis/boundary_features.h"
#include "skein/scenario/utc.h"

namespace skein::serve {
namespace {

struct FireFormat {
  std::string_view ending, type;
};
constexpr FireFormat kFormats[] = {{".gpkg", "application/geopackage+sqlite3"},
                                   {".shp.zip", "application/zip"},
                                   {".geojson", "application/geo+json"},
                                   {".kml", "application/vnd.google-earth.kml+xml"}};
constexpr std::string_view kPath = "/api/fire";

hmi::HttpAnswer refused(unsigned status, const std::string& why) {
  hmi::HttpAnswer answer;
  answer.status = status;
  answer.type = "text/plain; charset=utf-8";
  answer.body = std::make_shared<const std::string>(why + "\n");
  return answer;
}

std::vector<exchange::GisFeature> features_of(const hmi::FireState& fire,
                                              std::int64_t start_s) {
  const auto utc = [start_s](Time time) {
    return scenario::utc_text(start_s +
                              static_cast<std::int64_t>(std::floor(time.seconds())));
  };
  std::vector<exchange::GisFeature> features;
  for (hmi::FireState::Believed& each : fire.all()) {
    const exchange::BelievedBoundary belief{std::move(each.mission),
                                            std::move(each.boundary), each.made};
    for (const exchange::BoundaryLevel& level :
         each.made ? exchange::prediction_levels() : exchange::band_levels())
      features.push_back(exchange::boundary_feature(belief, level, utc));
  }
  return features;
}

}  // namespace

bool is_fire_file(std::string_view path) {
  if (!path.starts_with(kPath)) return false;
  path.remove_prefix(kPath.size());
  return std::any_of(std::begin(kFormats), std::end(kFormats),
                     [&](const FireFormat& format) { return format.ending == path; });
}

std::optional<hmi::HttpAnswer> fire_file(std::string_view path,
                                         const hmi::FireState& fire,
                                         const geo::LocalFrame& frame,
                                         std::int64_t start_s) {
  if (path.substr(0, kPath.size()) != kPath) return std::nullopt;
  for (const FireFormat& format : kFormats) {
    if (path.substr(kPath.size()) != format.ending) continue;
    const auto features = features_of(fire, start_s);
    if (features.empty()) return refused(404, "Nothing is believed of a fire yet.");
    auto bytes = exchange::gis_bytes(features, "fire", frame, std::string(format.ending));
    if (!bytes) return refused(500, bytes.error().text());
    hmi::HttpAnswer answer;
    answer.type = format.type;
    answer.body = std::make_shared<const std::string>(std::move(bytes).value());
    answer.file = "fire" + std::string(format.ending);
    return answer;
  }
  return std::nullopt;
}

}  // namespace skein::serve
