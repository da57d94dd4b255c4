// SPDX-License-Identifier: Apache-2.0
#include "app/serve/drawing_files.h"

#include <algorithm>
#include <cctype>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "skein/exchange/gis/map_features.h"

namespace skein::serve {
namespace {

using Json = nlohmann::ordered_json;
using exchange::MapFeature;

constexpr std::size_t kMaxFeatures = 2000;       // that a page may draw
constexpr std::size_t kMaxDrawnPoints = 50'000;  // of all of them
constexpr std::size_t kMaxNameLength = 100;

hmi::HttpAnswer with_status(unsigned status, const Json& value) {
  hmi::HttpAnswer answer;
  answer.status = status;
  answer.body = std::make_shared<const std::string>(
      value.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  return answer;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const int letter = std::toupper(static_cast<unsigned char>(c));
  return letter >= 'A' && letter <= 'F' ? letter - 'A' + 10 : -1;
}

// The name that a query gives, for messages only; without what a terminal would obey.
std::string name_in(std::string_view query) {
  constexpr std::string_view kKey = "name=";
  std::string name;
  if (query.starts_with(kKey)) query.remove_prefix(kKey.size());
  query = query.substr(0, query.find('&'));
  for (std::size_t i = 0; i < query.size() && name.size() < kMaxNameLength; ++i) {
    char c = query[i];
    if (c == '%' && i + 2 < query.size() && hex_digit(query[i + 1]) >= 0 &&
        hex_digit(query[i + 2]) >= 0) {
      c = static_cast<char>(16 * hex_digit(query[i + 1]) + hex_digit(query[i + 2]));
      i += 2;
    }
    name += static_cast<unsigned char>(c) < ' ' || c == '\x7F' ? '?' : c;
  }
  return name.empty() ? "the file" : name;
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
  const std::string name = name_in(request.query);
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
