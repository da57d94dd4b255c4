// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/gis/boundary_features.h"

#include "skein/geo/clip.h"

namespace skein::exchange {
namespace {

constexpr BoundaryLevel kBoundary[] = {{0.5, 0}};
constexpr BoundaryLevel kBands[] = {
    {0.975, -1.96}, {0.75, -0.6745}, {0.5, 0}, {0.25, 0.6745}, {0.025, 1.96}};
constexpr BoundaryLevel kPredictions[] = {{0.95, -1.645}, {0.5, 0}, {0.05, 1.645}};

// The boundary moved outward by `deviations` standard deviations.
geo::Region moved(const BoundaryEstimate& boundary, double deviations) {
  geo::Region region;
  for (const auto& points : boundary.rings) {
    if (points.size() < 3) continue;
    region.emplace_back();
    for (const BoundaryPoint& point : points)
      region.back().push_back(point.position + deviations * point.sigma * point.normal);
  }
  return geo::clean(region, geo::FillRule::kPositive);
}

double mean_sigma(const BoundaryEstimate& boundary) {
  double sum = 0;
  int count = 0;
  for (const auto& ring : boundary.rings)
    for (const BoundaryPoint& point : ring) {
      sum += point.sigma;
      ++count;
    }
  return count > 0 ? sum / count : 0;
}

}  // namespace

std::span<const BoundaryLevel> boundary_level() {
  return kBoundary;
}
std::span<const BoundaryLevel> band_levels() {
  return kBands;
}
std::span<const BoundaryLevel> prediction_levels() {
  return kPredictions;
}

GisFeature boundary_feature(const BelievedBoundary& belief, const BoundaryLevel& level,
                            const std::function<std::string(Time)>& utc) {
  GisFeature feature;
  feature.rings = moved(belief.boundary, level.deviations);
  const Time time = belief.boundary.time, made = belief.made.value_or(time);
  feature.fields = {{"mission", belief.mission},
                    {"time_utc", utc(time)},
                    {"time_s", time.seconds()},
                    {"made_utc", utc(made)},
                    {"ahead_min", (time - made).seconds() / 60},
                    {"prob", level.probability},
                    {"area_ha", geo::area(feature.rings) / 1e4},
                    {"sigma_m", mean_sigma(belief.boundary)}};
  return feature;
}

}  // namespace skein::exchange
