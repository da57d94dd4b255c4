// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "skein/data/event/record.h"
#include "skein/record/figures/metrics.h"
#include "skein/record/store/believer.h"

namespace skein::record {

/// A forecast and what came of it.
struct ForecastScore {
  Believer who;
  Time made, time;  ///< when, and for when
  PerimeterMetrics metrics;
};

/// How good forecasts were: each perimeter is compared with the true one of its time,
/// each distribution of an arrival with when the fire came.
class ForecastStatistics {
 public:
  void forecast(const ForecastRecord& record);
  void arrival(const ArrivalRecord& record);

  /// A true boundary: forecasts for this time, or for times since the last one, are
  /// scored.
  void truth(Time time, std::uint32_t phenomenon, const TrueBoundary& truth);

  /// The scores since the last call.
  std::vector<ForecastScore> take_scores();

  /// Gathers a score that was computed before (a reader of stored ones).
  void score(const ForecastScore& score);

  /// Adds `forecast_<horizon>s_<metric>_mean<unit>` for every horizon, of the mission
  /// that came first (others with `mission_<name>_` before it); `arrival_<place>_s`, when
  /// the first fire came to a place; and `arrival_crps_mean_s`, over forecasts whose last
  /// step has passed:
  ///
  ///   CRPS = integral over the steps of (F(t) - [fire is there at t])^2 dt
  ///
  /// Reference: [Gneiting07] Eq. (20).
  void add_figures(std::map<std::string, double>& figures) const;

 private:
  struct Mean {
    double sum = 0;
    int count = 0;
  };
  // Several missions may ask for one place, each about its own fire.
  using PlaceKey = std::pair<std::uint32_t, std::string>;  // phenomenon, name
  struct Place {
    Vec2 point = Vec2::Zero();
    std::optional<Time> reached;
  };
  using Horizon = std::pair<Believer, std::int64_t>;  // [ns]

  std::multimap<Time, ForecastRecord> open_;  // by the time that they are for
  std::vector<ForecastScore> scores_;
  std::vector<Believer> believers_;  // in order of their first forecasts
  std::map<Horizon, std::vector<Mean>> means_;
  std::vector<ArrivalForecast> arrivals_;
  std::map<PlaceKey, Place> places_;
  Time last_;
};

}  // namespace skein::record
