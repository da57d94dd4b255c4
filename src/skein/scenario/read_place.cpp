// SPDX-License-Identifier: Apache-2.0
// Places that are given as latitude and longitude, or as features of map files.

#include <fmt/format.h>

#include <filesystem>

#include "skein/geo/place_limits.h"
#include "skein/scenario/places.h"
#include "skein/scenario/read.h"
#include "skein/scenario/text.h"

namespace skein::scenario {
namespace {

constexpr const char* kForms =
    "A place is [north, east], {latitude_deg: .., longitude_deg: ..} or "
    "{feature: NAME, file: FILE}.";

}  // namespace

bool Reader::has_only(const Node& map, std::span<const std::string_view> keys) {
  for (const Node::Key& key : map.keys) {
    bool known = false;
    for (const std::string_view each : keys) known = known || key.text == each;
    if (known) continue;
    error(key.place, fmt::format("unknown key {} of a place.", quote(key.text)), kForms);
    return false;
  }
  return true;
}

std::optional<Vec2> Reader::geographic_place(const Node& node) {
  static constexpr std::string_view kKeys[] = {"latitude_deg", "longitude_deg"};
  if (!has_only(node, kKeys)) return std::nullopt;
  const Node* latitude = node.find("latitude_deg");
  const Node* longitude = node.find("longitude_deg");
  if (!latitude || !longitude) {
    error(node.place,
          fmt::format("has no {}.", latitude ? "longitude_deg" : "latitude_deg"), kForms);
    return std::nullopt;
  }
  const auto north = number(*latitude, {.at_least = -90, .at_most = 90});
  const auto east = number(*longitude, {.at_least = -180, .at_most = 180});
  // An origin that is not valid is a problem of its own.
  if (!north || !east || !places_->frame) return std::nullopt;
  const double distance = geo::distance_from_origin(*places_->frame, *north, *east);
  if (distance > geo::kMaxPlaceDistance) {
    const geo::Geodetic origin = places_->frame->origin();
    error(
        node.place,
        fmt::format("lies {:.0f} km from the origin, latitude {:.6g}, longitude {:.6g}; "
                    "at most {:.0f} km are allowed.",
                    distance / 1000, origin.latitude_deg, origin.longitude_deg,
                    geo::kMaxPlaceDistance / 1000),
        fmt::format(
            "Is the origin right? Here it would be origin: {{latitude_deg: {:.6g}, "
            "longitude_deg: {:.6g}}}.",
            *north, *east));
    return std::nullopt;
  }
  return places_->frame->to_plane(*north, *east);
}

std::optional<std::vector<Vec2>> Reader::feature_points(const Node& node,
                                                        FeatureUse use) {
  static constexpr std::string_view kKeys[] = {"feature", "file"};
  if (!has_only(node, kKeys)) return std::nullopt;
  const Node* name = node.find("feature");
  const Node* file = node.find("file");
  if (!file || !file->scalar() || (name && !name->scalar())) {
    error(node.place,
          "needs the name of a file and, in a file with several, of a feature.", kForms);
    return std::nullopt;
  }
  if (!places_->frame) return std::nullopt;  // a problem of its own
  if (!places_->features) {
    error(node.place, "no map files can be read here.", kForms);
    return std::nullopt;
  }
  NamedPath named = find_file(file->text, folders_.of(file->place), {});
  auto points =
      places_->features(named.path, name ? name->text : "", use, *places_->frame);
  if (points) return std::move(points).value();
  if (!named.hint.empty()) {  // it is somewhere else
    error(file->place, std::move(named.problem), std::move(named.hint));
    return std::nullopt;
  }
  const Error& why = points.error();
  error(name ? name->place : file->place,
        why.place.empty() ? why.message : fmt::format("{}: {}", why.place, why.message),
        why.hint);
  return std::nullopt;
}

std::optional<Vec2> Reader::place(const Node& node) {
  if (!node.find("file") && !node.find("feature")) return geographic_place(node);
  const auto points = feature_points(node, FeatureUse::kPoint);
  return points && !points->empty() ? std::optional(points->front()) : std::nullopt;
}

void Reader::read_feature_list(const ListType& type, const Node& node, void* target) {
  const auto points = feature_points(
      node, type.count.at_least >= 3 ? FeatureUse::kArea : FeatureUse::kLine);
  if (!points) return;
  if (points->size() < type.count.at_least || points->size() > type.count.at_most)
    return error(node.place, fmt::format("the feature has {} points; needs {}.",
                                         points->size(), expected(Type{type})));
  type.clear(target);
  for (const Vec2& point : *points) *static_cast<Vec2*>(type.append(target)) = point;
}

}  // namespace skein::scenario
