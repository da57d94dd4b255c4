// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "skein/campaign/batch/flight_watch.h"
#include "skein/campaign/batch/scenario_reader.h"
#include "skein/campaign/monitoring/monitoring_study.h"
#include "skein/record/report/study_report.h"

namespace skein::campaign {

/// An aircraft of the study, with a route of its size.
struct RobustAircraft {
  std::string name;
  std::vector<std::string> overrides;  ///< of the base scenario
  bool hovers = false;                 ///< after its route
  /// Airspeed of level flight at the largest lift [m/s]; 0: hovers.
  double stall = 0;
};

/// aerosonde (with a wing that stalls), bixler, quad.
std::vector<RobustAircraft> robust_aircraft();

/// Flights in wind, gusts and with wrong parameters, all drawn at random.
struct RobustnessStudy {
  std::filesystem::path base;          ///< robustness.yaml
  std::vector<std::string> aircraft;   ///< names; empty = all
  std::vector<std::string> overrides;  ///< for every run
  int first_seed = 1;
  int seeds = 1000;  ///< runs
};

/// One run per seed. Drawn evenly, by the seed alone: the aircraft; turbulence none,
/// light, moderate or severe; mean wind from 0 to 8 m/s from any direction. A cell has
/// the runs of one aircraft, turbulence and range of winds (0-4, 4-8 m/s).
/// Fails: kBadInput for an aircraft that does not exist or an override that does not fit.
Result<StudyPlan> plan_robustness_study(const RobustnessStudy& study,
                                        const ScenarioReader& reader);

/// What watches a run of the plan; to be given to it, then asked for its figures.
FlightWatch watch_of(const BatchItem& item);

/// Losses of control and the worst errors of each cell, and every run that was lost.
record::StudyReport robustness_report(const StudyPlan& plan,
                                      const std::vector<BatchOutcome>& outcomes);

}  // namespace skein::campaign
