// SPDX-License-Identifier: Apache-2.0
#include "app/serve/drawing_files.h"

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/serve/query.h"
#include "skein/exchange/gis/map_features.h"

namespace skein::serve {
namespace {

using Json = nlohmann::ordered_json;
using exchange::MapFeature;

constexpr std::size_t kMaxFeatures = 2000;       // that a page may draw
constexpr std::size_t kMaxDrawnPoints = 50'000;  // of all of them
constexpr std::string_view kParameters[] = {"name"};

hmi::HttpAnswer with_status(unsigned status, const Json& value) {
  hmi::HttpAnswer answer;
  answer.status = status;
  answer.body = std::make_shared<const std::string>(
      value.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  return answer;
}

// The name that a query gives, for messages only; without what a terminal would obey.
std::string file_name(const std::map<std::string, std::string>& query) {
  const auto given = query.find("name");
  if (given == query.end() || given->second.empty()) return "the file";
  std::string name = given->second;
  for (char& c : name)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7F') c = '?';
  return name;
}

Json ring_json(const std::vector<Vec2>& points) {
  Json ring = Json::array();
  for (const Vec2& p : points) ring.push_back({p.x(), p.y()});
  return ring;
}

Json feature_json(const MapFeature& feature) {
  const auto radius = feature.numbers.find("radius_m");
  const bool circle = feature.kind == MapFeature::Kind::kPoint &&
                      radius != feature.numbers.end() && radius->second > 0;
  Json rings = Json::array({ring_json(feature.points)});
  for (const geo::Ring& hole : feature.holes) rings.push_back(ring_json(hole));
  const char* kind = circle                                     ? "circle"
                     : feature.kind == MapFeature::Kind::kPoint ? "point"
                     : feature.kind == MapFeature::Kind::kLine  ? "line"
                                                                : "area";
  return {{"name", feature.name},
          {"purpose", feature.purpose},
          {"kind", kind},
          {"rings", std::move(rings)},
          {"radius_m", circle ? Json(radius->second) : Json(nullptr)}};
}

std::size_t points_of(const MapFeature& feature) {
  std::size_t points = feature.points.size();
  for (const geo::Ring& hole : feature.holes) points += hole.size();
  return points;
}

}  // namespace

hmi::HttpAnswer drawings_of(const hmi::HttpRequest& request,
                            const geo::LocalFrame& frame) {
  if (request.method != "POST") {
    hmi::HttpAnswer answer = with_status(405, {{"error", "only POST is answered here."}});
    answer.allow = "POST";
    return answer;
  }
  if (request.access.role == AccessRole::kViewer)
    return with_status(403, {{"error", "viewers do not draw."}});
  if (auto refused = refused_query(request.query, kParameters))
    return *std::move(refused);
  const std::string name = file_name(read_query(request.query, kParameters).value());
  std::vector<std::string> warnings;
  const auto features = exchange::read_map_text(request.body, name, frame, warnings);
  if (!features) return with_status(422, {{"error", features.error().text()}});
  std::size_t points = 0;
  for (const MapFeature& each : features.value()) points += points_of(each);
  if (features.value().size() > kMaxFeatures || points > kMaxDrawnPoints)
    return with_status(
        422, {{"error", name + ": has " + std::to_string(features.value().size()) +
                            " features with " + std::to_string(points) +
                            " points; at most 2000 with 50000 are drawn."}});
  Json list = Json::array();
  for (const MapFeature& each : features.value()) list.push_back(feature_json(each));
  return with_status(200, {{"features", std::move(list)}, {"notes", warnings}});
}

}  // namespace skein::serve
