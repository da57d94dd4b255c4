// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "skein/campaign/batch/lap_recorder.h"
#include "skein/campaign/batch/scenario_reader.h"
#include "skein/campaign/monitoring/monitoring_study.h"
#include "skein/record/report/study_report.h"

namespace skein::campaign {

/// Plans made for the wind against plans made as if there were none ([Selecky18] 8.4):
/// how closely one aircraft follows them.
struct FollowingStudy {
  std::filesystem::path base;          ///< wind-following.yaml
  std::vector<std::string> winds;      ///< names; empty = all
  std::vector<std::string> overrides;  ///< for every run
  int first_seed = 1;
  int seeds = 6;
};

/// Every wind, each with Dubins curves and trochoids, each at constant airspeed and in
/// time.
/// Fails: kBadInput for a wind that does not exist or an override that does not fit.
Result<StudyPlan> plan_following_study(const FollowingStudy& study,
                                       const ScenarioReader& reader);

/// Adds how far the aircraft was off its plan: `cross_track_rms_m`, `cross_track_max_m`,
/// and `cross_track_qNN_m`, the distance that NN % of the samples do not exceed, NN = 05,
/// 10, ... 95 and 99. The first half minute of following does not count.
void add_following_figures(const std::vector<LapSample>& samples,
                           std::map<std::string, double>& figures);

/// A flight that is drawn.
struct FollowingFlight {
  std::size_t cell = 0;  ///< of the plan
  std::vector<LapSample> samples;
};

/// Tables of the errors and how many times smaller they are with trochoids, their
/// distributions, and both flights over their plans.
record::StudyReport following_report(const FollowingStudy& study, const StudyPlan& plan,
                                     const std::vector<BatchOutcome>& outcomes,
                                     const std::vector<FollowingFlight>& shown);

/// `WIND/times_closer_p95` and its kin in time: the 95 % of Dubins plans over that of
/// trochoids, of the means over the seeds.
std::map<std::string, double> following_ratios(const StudyPlan& plan,
                                               const std::vector<BatchOutcome>& outcomes);

}  // namespace skein::campaign
