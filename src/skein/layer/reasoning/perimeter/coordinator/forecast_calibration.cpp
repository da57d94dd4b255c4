// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/coordinator/forecast_calibration.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/geo/boundary_index.h"

namespace skein::perimeter {
namespace {

constexpr double kFading = 0.7;        // of what was learned, with every forecast
constexpr double kMaxSquare = 25;      // of one point: outliers say little
constexpr double kMinDeviation = 0.1;  // [m]

}  // namespace

void ForecastCalibration::compare(const BoundaryEstimate& now) {
  if (!check_ || now.time < check_->time) return;
  const BoundaryEstimate check = *std::exchange(check_, std::nullopt);
  const geo::BoundaryIndex later(rings_of(now));
  if (later.empty()) return;
  double squares = 0;
  int points = 0;
  for (const auto& ring : check.rings)
    for (const BoundaryPoint& point : ring) {
      const double z =
          later.nearest(point.position).distance / std::max(point.sigma, kMinDeviation);
      squares += std::min(z * z, kMaxSquare);
      ++points;
    }
  if (points == 0) return;
  squares_ = kFading * squares_ + squares / points;
  weight_ = kFading * weight_ + 1;
}

double ForecastCalibration::spread() const {
  return std::sqrt(std::max(1.0, squares_ / weight_));
}

}  // namespace skein::perimeter
