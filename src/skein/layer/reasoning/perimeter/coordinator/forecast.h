// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "skein/data/perimeter/fire.h"
#include "skein/role/perimeter_estimator.h"

namespace skein::perimeter {

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
  Time made;
  std::vector<BoundaryEstimate> boundaries;  ///< one for each horizon
  std::vector<ArrivalForecast> arrivals;     ///< one for each place
  BoundaryEstimate check;                    ///< one period ahead, with a spread of 1
};

/// A forecast that is made in parts: looking an hour ahead takes an estimator longer than
/// one step of an agent may.
class ForecastRun {
 public:
  /// @param estimator  at a time not after `now`; it is left as it is.
  /// @param options    with a horizon at least.
  /// @param spread     factor on its deviations: see ForecastCalibration.
  ForecastRun(const PerimeterEstimator& estimator, Time now,
              const ForecastOptions& options, double spread);

  /// Looks on by a minute or two. @returns whether it is done.
  bool advance();

  /// What it says. After advance() has returned true, once.
  Forecast take();

 private:
  void look(double seconds);

  ForecastOptions options_;
  Time now_;
  double spread_;
  std::unique_ptr<PerimeterEstimator> ahead_;
  std::vector<double> steps_;  // times ahead that are looked at, growing [s]
  std::size_t next_ = 0;       // of them
  double reached_ = 0;         // so far ahead the estimator is [s]
  Forecast said_;
};

/// Probability that a place is inside a boundary: Phi(-d / sigma), with the distance d to
/// the boundary, negative inside, and the deviation of its nearest point. 0 without a
/// boundary.
double probability_inside(const BoundaryEstimate& boundary, const Vec2& place);

}  // namespace skein::perimeter
