// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "skein/campaign/batch/batch.h"
#include "skein/campaign/batch/scenario_reader.h"

namespace skein::campaign {

/// A named set of changes to a base scenario.
struct Variant {
  std::string name;
  std::string help;
  std::vector<std::string> overrides;  ///< KEY=VALUE
};

/// The cases of wind and rate (docs/study-monitoring.md), as changes to
/// thesis-no-wind.yaml.
std::vector<Variant> monitoring_cases();

/// The strategies with the readings of the benchmark distinguished: `tracking-predicted`,
/// `tracking-binary`, `tracking-ideal`.
std::vector<Variant> monitoring_strategies();

/// Whether an estimator is one of the thesis's or of its benchmark; all others are
/// Skein's own.
bool of_the_thesis(const std::string& estimator);

struct MonitoringStudy {
  std::filesystem::path base;           ///< the scenario that the cases change
  std::vector<std::string> cases;       ///< names; empty = all
  std::vector<std::string> estimators;  ///< empty = all of the table
  std::vector<std::string> strategies;  ///< empty = all
  std::vector<std::string> overrides;   ///< for every run
  int first_seed = 1;
  int seeds = 6;
};

/// One combination, its runs and what they gave.
struct StudyCell {
  std::string case_name, estimator, strategy;
  std::vector<std::size_t> items;  ///< indices of its runs, one per seed

  /// CASE/STRATEGY/ESTIMATOR, without those that are empty.
  std::string path() const;
};

struct StudyPlan {
  std::vector<BatchItem> items;
  std::vector<StudyCell> cells;
  /// What the three parts of a cell's path are called.
  std::array<std::string, 3> dimensions = {"case", "strategy", "estimator"};
};

/// All runs of the study.
/// Fails: kBadInput for a name that does not exist or an override that does not fit.
Result<StudyPlan> plan_monitoring_study(const MonitoringStudy& study,
                                        const ScenarioReader& reader);

/// How often a figure is there in the runs of a cell, their sum, the smallest and the
/// largest; mean and these two are NaN where no run has it.
struct FigureTally {
  double count = 0, sum = 0, min = std::nan(""), max = std::nan("");
  double mean() const { return sum / count; }
};

FigureTally tally_of(const StudyCell& cell, const std::vector<BatchOutcome>& outcomes,
                     const std::string& name);

/// Mean and confidence interval of the figure `name` over the runs of a cell.
MeanInterval figure_of(const StudyCell& cell, const std::vector<BatchOutcome>& outcomes,
                       const std::string& name);

/// For a table: "12.3 ± 0.4", without the interval for one run, with "(n = 3)" when runs
/// are missing; empty without any value.
std::string figure_text(const MeanInterval& figure, int digits);

/// Whether a figure says how long the machine took: it differs from run to run, and
/// summaries and rows of runs leave it out.
bool depends_on_machine(const std::string& name);

/// "partial: 5 of 20 runs", with how many failed; empty when all runs ended well.
std::string partial_text(const std::vector<BatchOutcome>& outcomes);

/// Every different warning of the runs, in order.
std::vector<std::string> warnings_of(const std::vector<BatchOutcome>& outcomes);

}  // namespace skein::campaign
