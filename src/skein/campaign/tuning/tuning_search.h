// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "skein/campaign/batch/scenario_reader.h"
#include "skein/campaign/tuning/simplex_search.h"
#include "skein/campaign/tuning/tuning_study.h"

namespace skein::campaign {

/// A search for gains that cost little. Each gain is moved as the logarithm of its ratio
/// to where it starts, within a factor of four, and rounded to four digits.
struct TuningSearch {
  TuningStudy study;              ///< scenario, overrides and seeds; `sets` do not count
  std::vector<std::string> keys;  ///< of the gains that are moved
  std::vector<double> start;      ///< their values, above 0
  /// The gains with these values, as an entry of `lap_gains`.
  std::function<std::string(const std::vector<double>& values)> lap_gains;
  int evaluations = 60;  ///< maximum number of gains to try
  /// Called after each; may be empty.
  std::function<void(int tried, double best_cost)> progress;
};

/// What the search tried; points are values of the gains.
struct TuningFound {
  SimplexResult search;
  std::string error;  ///< why a flight failed; empty: none did
};

/// Minimises the mean of flight_cost() over the seeds. All flights go through the
/// journal, so that a search which was interrupted goes on where it was.
/// Fails: as plan_comparison() and run_batch().
Result<TuningFound> search_gains(const TuningSearch& search, const ScenarioReader& reader,
                                 const RunScenario& run, const BatchOptions& options);

}  // namespace skein::campaign
