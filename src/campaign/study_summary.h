#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "campaign/estimators_study.h"
#include "campaign/monitoring_study.h"

namespace skein::campaign {

/// Numbers under flat names, as `summary.json` of a study has them.
using StudyFigures = std::map<std::string, double>;

/// Of a study of many runs: for every cell and every figure of its runs' summaries
///
///   CASE/STRATEGY/ESTIMATOR/FIGURE         mean over the runs
///   CASE/STRATEGY/ESTIMATOR/FIGURE_ci95    half width of its 95 % interval
///
/// and `runs`, `runs_failed`, `runs_missing`. What depends on the machine is left out.
StudyFigures study_figures(const StudyPlan& plan,
                           const std::vector<BatchOutcome>& outcomes);

/// Of tables that have a column `exact`: TABLE/COLUMN_max_error, the largest distance of
/// each other column from it, in the table's unit.
StudyFigures study_figures(std::span<const StudyTable> tables);

/// Writes `DIR/summary.json`: study, version, then the figures.
/// Fails: kUnavailable when the file cannot be written.
Result<void> write_study_summary(const std::string& study, const std::string& version,
                                 const StudyFigures& figures,
                                 const std::filesystem::path& folder);

}  // namespace skein::campaign
