// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/recorded/fire_features.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string_view>

#include "skein/layer/environment/recorded/attributes.h"
#include "skein/layer/environment/recorded/feature_times.h"

namespace skein::environment {
namespace {

using Features = std::vector<VectorFeature>;

constexpr std::string_view kIncidents[] = {"incidentname", "firename", "incident",
                                           "fire"};
constexpr std::string_view kDeleted[] = {"deletethis"};
constexpr std::string_view kCategories[] = {"featurecategory"};

bool has_area(const VectorFeature& feature) {
  return !feature.outline.polygons.empty();
}

Result<void> keep_incident(Features& features, const std::string& place,
                           const std::string& incident) {
  std::map<std::string, int> incidents;
  std::vector<std::string> names(features.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    const Attribute* name = find_known(features[i], kIncidents);
    names[i] = name != nullptr ? in_capitals(name->text) : "";
    if (!names[i].empty()) ++incidents[names[i]];
  }
  const std::string requested = in_capitals(incident);
  if (requested.empty() && incidents.size() < 2) return {};
  if (!incidents.contains(requested)) {
    std::vector<std::pair<int, std::string>> all;
    for (const auto& [name, count] : incidents) all.emplace_back(-count, name);
    std::sort(all.begin(), all.end());
    std::string list;
    for (std::size_t i = 0; i < all.size() && i < 12; ++i)
      list += fmt::format("{}{} ({})", i > 0 ? ", " : "", all[i].second, -all[i].first);
    if (all.size() > 12) list += fmt::format(" and {} more", all.size() - 12);
    return Error{ErrorCode::kBadInput, place,
                 requested.empty() ? fmt::format("holds {} incidents", incidents.size())
                                   : fmt::format("has no incident \"{}\"", incident),
                 "name one as incident; by number of features: " +
                     (list.empty() ? "none has a name" : list)};
  }
  Features kept;
  for (std::size_t i = 0; i < features.size(); ++i)
    if (names[i] == requested) kept.push_back(std::move(features[i]));
  features = std::move(kept);
  return {};
}

// Without what is deleted, of another category, or a line beside areas.
void keep_perimeters(Features& features, Assumptions& assumed) {
  const auto leave_out = [&](const auto& is_out, const std::string& what) {
    const std::size_t before = features.size();
    std::erase_if(features, is_out);
    if (features.size() < before)
      assumed.add(
          fmt::format("{} feature(s) left out: {}", before - features.size(), what));
  };
  leave_out(
      [](const VectorFeature& feature) {
        const Attribute* deleted = find_known(feature, kDeleted);
        return deleted != nullptr && in_capitals(deleted->text) == "YES";
      },
      "marked as deleted");
  const auto category = [](const VectorFeature& feature) {
    const Attribute* found = find_known(feature, kCategories);
    return found != nullptr ? in_capitals(found->text) : std::string();
  };
  const auto is_perimeter = [&](const VectorFeature& feature) {
    return category(feature).find("PERIMETER") != std::string::npos;
  };
  if (std::any_of(features.begin(), features.end(), is_perimeter))
    leave_out([&](const VectorFeature& feature) { return !is_perimeter(feature); },
              "of another category than perimeters");
  std::set<std::string> with_areas;
  for (const VectorFeature& feature : features)
    if (has_area(feature)) with_areas.insert(feature.layer);
  leave_out(
      [&](const VectorFeature& feature) {
        return !with_areas.empty() && !with_areas.contains(feature.layer) &&
               !feature.outline.lines.empty();
      },
      "lines, in layers beside those with areas");
}

Error no_time(const VectorFeature& feature) {
  return {ErrorCode::kBadInput, feature.outline.place, "has no attribute with a time",
          time_hint(feature)};
}

}  // namespace

Error mixed_times(const std::string& place) {
  return {
      ErrorCode::kBadInput, place,
      "has a time of another kind than the ones before it: seconds and dates are mixed",
      ""};
}

Result<RawSeries> dated_perimeters(std::vector<VectorFeature> features,
                                   const std::string& place,
                                   const PerimeterFileOptions& options,
                                   std::vector<std::string>& warnings) {
  Assumptions assumed;
  if (auto good = keep_incident(features, place, options.incident); !good)
    return good.error();
  keep_perimeters(features, assumed);
  RawSeries series;
  std::size_t without = 0;
  bool first = true;
  std::optional<Error> problem;
  for (std::size_t i = 0; i < features.size();) {
    std::size_t end = i + 1;
    while (end < features.size() && features[end].layer == features[i].layer &&
           file_of(features[end]) == file_of(features[i]))
      ++end;
    const std::span<VectorFeature> layer(&features[i], end - i);
    auto times = times_of_layer(layer, options, assumed);
    if (!times) return times.error();
    for (std::size_t k = 0; k < layer.size(); ++k) {
      const auto& time = times.value()[k];
      if (!time) {
        ++without;
        if (!problem) problem = no_time(layer[k]);
        continue;
      }
      if (!first && time->utc != series.utc) return mixed_times(layer[k].outline.place);
      first = false;
      series.utc = time->utc;
      layer[k].outline.time = time->value;
      series.perimeters.push_back(std::move(layer[k].outline));
    }
    i = end;
  }
  if (first)
    return problem.value_or(Error{ErrorCode::kBadInput, place, "has no perimeter", ""});
  if (without > 0)
    assumed.add(fmt::format("{} feature(s) without a time left out", without));
  for (const std::string& each : assumed.all())
    warnings.push_back(fmt::format("{}: {}", place, each));
  return series;
}

}  // namespace skein::environment
