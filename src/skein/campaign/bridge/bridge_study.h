// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "skein/campaign/batch/scenario_reader.h"
#include "skein/campaign/monitoring/monitoring_study.h"
#include "skein/record/report/study_report.h"

namespace skein::campaign {

/// A real fire as truth, watched by a few aircraft that are given neither wind nor fuel
/// nor rates.
struct BridgeStudy {
  std::filesystem::path base;           ///< bridge-fire.yaml
  std::vector<std::string> estimators;  ///< empty = ensemble, joint, point-reset
  std::vector<std::string> strategies;  ///< empty = sweep, tracking-binary, gus-rate, gus
  std::vector<std::string> overrides;   ///< for every run
  int first_seed = 1;
  int seeds = 6;
};

/// All runs of the study. Fails: kBadInput as plan_monitoring_study().
Result<StudyPlan> plan_bridge_study(const BridgeStudy& study,
                                    const ScenarioReader& reader);

/// One row per combination: means over the allocation phase and all seeds, against the
/// marks to reach (IoU 0.90, RMS 35 m, Hausdorff 120 m, coverage 0.85).
record::StudyReport bridge_report(const BridgeStudy& study, const StudyPlan& plan,
                                  const std::vector<BatchOutcome>& outcomes);

}  // namespace skein::campaign
