#pragma once

#include <string>
#include <vector>

#include "skein/data/fire.h"
#include "skein/geo/polygon.h"
#include "skein/role/perimeter_estimator.h"

namespace skein::monitoring {

/// A place whose people want to know when the fire comes.
struct ArrivalPlace {
  std::string name;
  Vec2 point = Vec2::Zero();  ///< [m]
};

struct ForecastOptions {
  std::vector<double> horizons;      ///< ahead, growing [s]; empty: no forecasts
  Time period;                       ///< between two forecasts
  std::vector<ArrivalPlace> places;  ///< for which arrivals are forecast
};

/// What a belief says of the times ahead, if nothing more is observed: by the
/// estimator's own model of how the boundary moves and how its uncertainty grows.
struct Forecast {
  std::vector<BoundaryEstimate> boundaries;  ///< one for each horizon
  std::vector<ArrivalForecast> arrivals;     ///< one for each place
  BoundaryEstimate check;                    ///< one period ahead, with a spread of 1
};

/// @param estimator  at a time not after `now`; it is left as it is.
/// @param spread     factor on its deviations: see ForecastCalibration.
/// Cost: that of predicting its outlook() to the last horizon.
Forecast forecast(const PerimeterEstimator& estimator, Time now,
                  const ForecastOptions& options, double spread = 1);

/// The rings of a boundary that enclose something.
geo::Region rings_of(const BoundaryEstimate& boundary);

/// Probability that a place is inside a boundary: Phi(-d / sigma), with the distance d to
/// the boundary, negative inside, and the deviation of its nearest point. 0 without a
/// boundary.
double probability_inside(const BoundaryEstimate& boundary, const Vec2& place);

}  // namespace skein::monitoring
