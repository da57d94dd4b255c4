// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "skein/campaign/estimators/estimators_study.h"
#include "skein/campaign/monitoring/monitoring_study.h"

namespace skein::campaign {

/// Numbers under flat names, as `summary.json` of a study has them.
using StudyFigures = std::map<std::string, double>;

/// Of a study of many runs: for every cell and every figure of its runs' summaries
///
///   CASE/STRATEGY/ESTIMATOR/FIGURE         mean over the runs
///   CASE/STRATEGY/ESTIMATOR/FIGURE_ci95    half width of its 95 % interval
///   CASE/STRATEGY/ESTIMATOR/runs           how many runs these are of
///
/// and `runs`, `runs_failed`, `runs_missing`. What depends on the machine is left out.
StudyFigures study_figures(const StudyPlan& plan,
                           const std::vector<BatchOutcome>& outcomes);

/// Of tables that have a column `exact_UNIT`: TABLE/COLUMN_max_error_UNIT, the largest
/// distance from it of each other column of that unit: `mean_above/qkf_max_error_m`.
StudyFigures study_figures(std::span<const CurveTable> tables);

/// Writes `DIR/summary.json`: study, version, state ("complete" or "partial: 5 of 20
/// runs"), then the figures. Fails: kUnavailable when the file cannot be written.
Result<void> write_study_summary(const std::string& study, const std::string& version,
                                 const std::string& state, const StudyFigures& figures,
                                 const std::filesystem::path& folder);

}  // namespace skein::campaign
