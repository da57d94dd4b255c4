// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "skein/campaign/batch/scenario_reader.h"
#include "skein/campaign/monitoring/monitoring_study.h"
#include "skein/record/report/study_report.h"

namespace skein::campaign {

/// The steps from a point to an aircraft in gusts that sees its sensors only, as changes
/// to a scenario; each changes one layer more.
std::vector<Variant> fidelity_levels();

/// One mission, flown at several fidelities.
struct FidelityStudy {
  std::filesystem::path base;          ///< wildfire.yaml
  std::vector<std::string> levels;     ///< names; empty = all
  std::vector<std::string> overrides;  ///< for every run
  int first_seed = 1;
  int seeds = 6;
};

/// All runs of the study.
/// Fails: kBadInput for a level that does not exist or an override that does not fit.
Result<StudyPlan> plan_fidelity_study(const FidelityStudy& study,
                                      const ScenarioReader& reader);

/// What the mission achieves at each fidelity, what the aircraft do, and what a run
/// costs.
record::StudyReport fidelity_report(const FidelityStudy& study, const StudyPlan& plan,
                                    const std::vector<BatchOutcome>& outcomes);

}  // namespace skein::campaign
