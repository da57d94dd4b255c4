// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "skein/campaign/batch/scenario_reader.h"
#include "skein/campaign/keeping/keeping_watch.h"
#include "skein/campaign/monitoring/monitoring_study.h"
#include "skein/record/report/study_report.h"

namespace skein::campaign {

/// How closely a glider keeps to its route and a quadrotor to its place, by receiver and
/// turbulence.
struct KeepingStudy {
  std::filesystem::path base;          ///< keeping.yaml
  std::vector<std::string> aircraft;   ///< names; empty = all
  std::vector<std::string> overrides;  ///< for every run
  int first_seed = 1;
  int seeds = 20;
};

/// Every aircraft (bixler, quad) with every turbulence (none, light) and every receiver
/// (the true state, rtk, differential, single), `seeds` runs each.
/// Fails: kBadInput for an aircraft that does not exist or an override that does not fit.
Result<StudyPlan> plan_keeping_study(const KeepingStudy& study,
                                     const ScenarioReader& reader);

/// What watches a run of the plan; to be given to it, then asked for its figures.
KeepingWatch keeping_watch_of(const BatchItem& item);

/// Mean and worst over the seeds of every cell.
record::StudyReport keeping_report(const StudyPlan& plan,
                                   const std::vector<BatchOutcome>& outcomes);

/// `AIRCRAFT/TURBULENCE/RECEIVER/FIGURE_mean` and `_most` over the seeds.
std::map<std::string, double> keeping_figures(const StudyPlan& plan,
                                              const std::vector<BatchOutcome>& outcomes);

}  // namespace skein::campaign
