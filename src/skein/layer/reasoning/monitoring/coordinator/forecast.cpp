#include "skein/layer/reasoning/monitoring/coordinator/forecast.h"

#include <algorithm>
#include <cmath>

#include "skein/geo/boundary_index.h"
#include "skein/model/probability/normal.h"

namespace skein::monitoring {
namespace {

constexpr int kArrivalSteps = 12;  // of the distribution, to the last horizon
constexpr double kMinSigma = 0.1;  // [m]

// When the distribution passes a probability [s]; none: not within its steps.
std::optional<double> quantile(const std::vector<ArrivalStep>& steps,
                               double probability) {
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (steps[k].probability < probability) continue;
    if (k == 0) return steps[0].time.seconds();
    const ArrivalStep& a = steps[k - 1];
    const double share =
        (probability - a.probability) / (steps[k].probability - a.probability);
    return a.time.seconds() + share * (steps[k].time - a.time).seconds();
  }
  return std::nullopt;
}

// Times of all boundaries that are needed [s]: horizons, steps of the distributions, and
// the check.
std::vector<double> steps_ahead(const ForecastOptions& options) {
  std::vector<double> ahead = options.horizons;
  ahead.push_back(options.period.seconds());
  if (!options.places.empty())
    for (int k = 0; k <= kArrivalSteps; ++k)
      ahead.push_back(options.horizons.back() * k / kArrivalSteps);
  std::sort(ahead.begin(), ahead.end());
  ahead.erase(std::unique(ahead.begin(), ahead.end()), ahead.end());
  return ahead;
}

}  // namespace

geo::Region rings_of(const BoundaryEstimate& boundary) {
  geo::Region region;
  for (const auto& points : boundary.rings) {
    if (points.size() < 3) continue;
    region.emplace_back();
    for (const BoundaryPoint& point : points) region.back().push_back(point.position);
  }
  return region;
}

double probability_inside(const BoundaryEstimate& boundary, const Vec2& place) {
  const geo::BoundaryIndex index(rings_of(boundary));
  if (index.empty()) return 0;
  const geo::NearestPoint nearest = index.nearest(place);
  // Rings of less than three points are no part of the index.
  std::size_t ring = 0;
  for (int left = nearest.ring;; ++ring)
    if (boundary.rings[ring].size() >= 3 && left-- == 0) break;
  const auto& points = boundary.rings[ring];
  const auto edge = static_cast<std::size_t>(nearest.edge);
  const double from = points[edge].sigma, to = points[(edge + 1) % points.size()].sigma;
  const double sigma = std::max(from + nearest.along * (to - from), kMinSigma);
  const double distance = index.contains(place) ? -nearest.distance : nearest.distance;
  return model::normal_cdf(-distance / sigma);
}

Forecast forecast(const PerimeterEstimator& estimator, Time now,
                  const ForecastOptions& options, double spread) {
  Forecast all;
  if (options.horizons.empty()) return all;
  for (const ArrivalPlace& place : options.places) {
    ArrivalForecast arrival;
    arrival.made = now;
    arrival.place = place.name;
    arrival.point = place.point;
    all.arrivals.push_back(std::move(arrival));
  }
  const auto ahead = estimator.outlook();
  const double last = options.horizons.back();
  for (const double seconds : steps_ahead(options)) {
    const Time time = now + Time::from_seconds(seconds);
    ahead->predict(time);
    BoundaryEstimate boundary = ahead->boundary();
    if (seconds == options.period.seconds()) all.check = boundary;
    for (auto& ring : boundary.rings)
      for (BoundaryPoint& point : ring) point.sigma *= spread;
    for (ArrivalForecast& arrival : all.arrivals) {
      if (seconds > last) continue;
      const double before = arrival.steps.empty() ? 0 : arrival.steps.back().probability;
      // What burns keeps burning.
      const double probability = probability_inside(boundary, arrival.point);
      arrival.steps.push_back({time, std::max(before, probability)});
    }
    if (std::count(options.horizons.begin(), options.horizons.end(), seconds) > 0)
      all.boundaries.push_back(std::move(boundary));
  }
  for (ArrivalForecast& arrival : all.arrivals) {
    arrival.early = quantile(arrival.steps, 0.1);
    arrival.middle = quantile(arrival.steps, 0.5);
    arrival.late = quantile(arrival.steps, 0.9);
  }
  return all;
}

}  // namespace skein::monitoring
