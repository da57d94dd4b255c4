// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/campaign/avoidance/avoidance_cases.h"
#include "skein/campaign/batch/scenario_reader.h"
#include "skein/campaign/monitoring/monitoring_study.h"
#include "skein/data/traffic/separation.h"
#include "skein/geo/vec.h"
#include "skein/record/report/study_report.h"

namespace skein::campaign {

/// How the cases are flown.
struct AvoidanceStudy {
  std::vector<AvoidanceCase> cases;
  std::string method = "auto";
  std::string plant = "path";  ///< "path", or "fixed-wing"
  double loss = 0, delay = 0;  ///< of messages; [s]
  double range = 0;            ///< of radio and sensors for traffic [m]; 0: their own
  /// What finds intruders: "perfect", "adsb", "passive", "radar".
  std::string tracks = "perfect";
  std::string room = "moving";  ///< of intruders, kept free: "moving" or "static"
  std::string deal = "sum";     ///< "sum", "product" or "zeuthen"
  std::optional<Vec2> wind;     ///< instead of that of the cases [m/s]
  std::string turbulence = "none";
  Separation separation;
  double horizon = 90;  ///< [s]
  int seed = 1;
};

/// A run for each case.
/// Fails: kBadInput for a method, plant or tracks that do not exist, or wind as strong as
///        an airspeed.
Result<StudyPlan> plan_avoidance_study(const AvoidanceStudy& study,
                                       const ScenarioReader& reader);

/// The time that a flight from start to goal takes with nobody in the way [s].
double undisturbed_time(const AvoidanceAircraft& aircraft, const Vec2& wind);

/// What is kept in a case: with an intruder, what is kept to intruders.
Separation separation_of(const AvoidanceStudy& study, const AvoidanceCase& flown);

/// The figures of the runs as CSV: case, method, min_ratio, min_horizontal_m, violations,
/// nmac, lowc (pairs of aircraft), extra_time_s, extra_percent (mean over those that
/// arrived), arrived, messages, bytes, worst_decision_ms,
/// least_fixed_before_s, worst_extra_percent, worst_extra_time_s, conflicts, deals,
/// decision_ms_per_s (of all that an aircraft thinks, for each second that it flies),
/// cost_s (mean of what manoeuvres cost as flown: how much earlier or later, and 0.05 s
/// for each metre climbed or descended).
std::string avoidance_csv(const AvoidanceStudy& study, const StudyPlan& plan,
                          const std::vector<BatchOutcome>& outcomes);

/// The same by kind of case (its name without what follows the last dash): sums of
/// violations, means and worst of the rest.
record::StudyTable avoidance_table(const StudyPlan& plan,
                                   const std::vector<BatchOutcome>& outcomes);

}  // namespace skein::campaign
