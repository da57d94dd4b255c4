// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "skein/campaign/batch/scenario_reader.h"
#include "skein/campaign/ground_starts/start_watch.h"
#include "skein/campaign/monitoring/monitoring_study.h"
#include "skein/record/report/study_report.h"

namespace skein::campaign {

/// Starts from the ground in wind and gusts and with wrong parameters, all drawn at
/// random.
struct GroundStartsStudy {
  std::filesystem::path base;          ///< ground-starts.yaml
  std::vector<std::string> aircraft;   ///< names; empty = all
  std::vector<std::string> overrides;  ///< for every run
  int first_seed = 1;
  int seeds = 500;  ///< runs
};

/// One run per seed. Drawn evenly, by the seed alone: the aircraft; turbulence, up to the
/// strongest that it is started in; mean wind from 0 to 8 m/s from any direction; whether
/// a crew faces it into the wind or it stands with any heading. A cell has the runs of
/// one aircraft, turbulence and attitude on the ground.
/// Fails: kBadInput for an aircraft that does not exist or an override that does not fit.
Result<StudyPlan> plan_ground_starts_study(const GroundStartsStudy& study,
                                           const ScenarioReader& reader);

/// What watches a run of the plan; to be given to it, then asked for its figures.
StartWatch start_watch_of(const BatchItem& item);

/// Losses and the worst errors of each cell, and every start that was lost.
record::StudyReport ground_starts_report(const StudyPlan& plan,
                                         const std::vector<BatchOutcome>& outcomes);

}  // namespace skein::campaign
