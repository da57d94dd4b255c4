// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/map_places.h"

#include <fmt/format.h>

#include "skein/exchange/gis/map_features.h"

namespace skein::assemble {
namespace {

using exchange::MapFeature;
using scenario::FeatureUse;

bool is_used_as(const MapFeature& feature, FeatureUse use) {
  switch (use) {
    case FeatureUse::kPoint:
      return feature.kind == MapFeature::Kind::kPoint;
    case FeatureUse::kLine:
      return feature.kind != MapFeature::Kind::kPoint;
    case FeatureUse::kArea:
      return feature.kind == MapFeature::Kind::kArea;
  }
  return false;
}

std::string_view word_for(FeatureUse use) {
  return use == FeatureUse::kPoint ? "point" : use == FeatureUse::kLine ? "line" : "area";
}

// What a file has of that use, for messages.
std::string names_in(const std::vector<MapFeature>& features, FeatureUse use) {
  constexpr int kShown = 8;
  std::string names;
  int count = 0;
  for (const MapFeature& feature : features) {
    if (!is_used_as(feature, use) || feature.name.empty() || ++count > kShown) continue;
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", feature.name);
  }
  if (names.empty()) return fmt::format("It has no {} with a name.", word_for(use));
  return fmt::format("It has {}{}.", names,
                     count > kShown ? fmt::format(" and {} more", count - kShown) : "");
}

}  // namespace

Result<std::vector<Vec2>> feature_points(const std::string& file, const std::string& name,
                                         FeatureUse use, const geo::LocalFrame& frame) {
  std::vector<std::string> oddities;  // of the whole map: they do not matter here
  auto features = exchange::read_map(file, &frame, oddities);
  if (!features) return features.error();
  const MapFeature* found = nullptr;
  for (const MapFeature& feature : features.value()) {
    if (!is_used_as(feature, use) || (!name.empty() && feature.name != name)) continue;
    if (found)
      return Error{ErrorCode::kBadInput, file,
                   name.empty() ? fmt::format("has several {}s.", word_for(use))
                                : fmt::format("several {}s are called \"{}\".",
                                              word_for(use), name),
                   name.empty() ? names_in(features.value(), use) : ""};
    found = &feature;
  }
  if (found) return found->points;
  return Error{ErrorCode::kNotFound, file,
               name.empty() ? fmt::format("has no {}.", word_for(use))
                            : fmt::format("has no {} \"{}\".", word_for(use), name),
               names_in(features.value(), use)};
}

}  // namespace skein::assemble
