// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/coordinator/forecast.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/check.h"
#include "skein/geo/boundary_index.h"
#include "skein/model/probability/normal.h"

namespace skein::perimeter {
namespace {

constexpr double kPart = 120;      // looked ahead at a time [s]
constexpr int kArrivalSteps = 12;  // of the distribution, to the last horizon
constexpr double kMinSigma = 0.1;  // [m]
// Shares of the distribution of arrivals by which the fire is there.
constexpr double kEarly = 0.1, kMiddle = 0.5, kLate = 0.9;

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

ForecastRun::ForecastRun(const PerimeterEstimator& estimator, Time now,
                         const ForecastOptions& options, double spread)
    : options_(options),
      now_(now),
      spread_(spread),
      ahead_(estimator.outlook()),
      steps_(steps_ahead(options)) {
  SKEIN_CHECK(!options.horizons.empty());
  said_.made = now;
  for (const ArrivalPlace& place : options_.places) {
    ArrivalForecast& arrival = said_.arrivals.emplace_back();
    arrival.made = now;
    arrival.place = place.name;
    arrival.point = place.point;
  }
}

bool ForecastRun::advance() {
  if (next_ == steps_.size()) return true;
  reached_ = std::min(reached_ + kPart, steps_[next_]);
  ahead_->predict(now_ + Time::from_seconds(reached_));
  if (reached_ == steps_[next_]) look(steps_[next_++]);
  return next_ == steps_.size();
}

void ForecastRun::look(double seconds) {
  BoundaryEstimate boundary = ahead_->boundary();
  if (seconds == options_.period.seconds()) said_.check = boundary;
  for (auto& ring : boundary.rings)
    for (BoundaryPoint& point : ring) point.sigma *= spread_;
  if (seconds <= options_.horizons.back())
    for (ArrivalForecast& arrival : said_.arrivals) {
      const double before = arrival.steps.empty() ? 0 : arrival.steps.back().probability;
      // What burns keeps burning.
      const double probability = probability_inside(boundary, arrival.point);
      arrival.steps.push_back({boundary.time, std::max(before, probability)});
    }
  if (std::count(options_.horizons.begin(), options_.horizons.end(), seconds) > 0)
    said_.boundaries.push_back(std::move(boundary));
}

Forecast ForecastRun::take() {
  for (ArrivalForecast& arrival : said_.arrivals) {
    arrival.early = quantile(arrival.steps, kEarly);
    arrival.middle = quantile(arrival.steps, kMiddle);
    arrival.late = quantile(arrival.steps, kLate);
  }
  return std::move(said_);
}

}  // namespace skein::perimeter
