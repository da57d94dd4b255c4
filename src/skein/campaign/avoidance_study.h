#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/campaign/monitoring_study.h"
#include "skein/data/separation.h"
#include "skein/geo/vec.h"
#include "skein/record/study_report.h"

namespace skein::campaign {

/// An aircraft of a case: it flies from a place straight to another.
struct AvoidanceAircraft {
  Vec3 start = Vec3::Zero(), goal = Vec3::Zero();  ///< p_N [m]
  double airspeed = 20;                            ///< [m/s]
};

/// Aircraft that will meet.
struct AvoidanceCase {
  std::string name;
  Vec2 wind = Vec2::Zero();  ///< velocity of the air [m/s]
  std::vector<AvoidanceAircraft> aircraft;
};

/// Reads cases from a CSV file: `case, aircraft` (from 1), `start_north_m, start_east_m,
/// start_down_m, goal_north_m, goal_east_m, goal_down_m, airspeed_mps`, and where there
/// is wind `wind_north_mps, wind_east_mps` (velocity of the air). Other columns are
/// passed over. Fails: kBadInput with line and column; kUnavailable when the file cannot
/// be read.
Result<std::vector<AvoidanceCase>> read_avoidance_cases(
    const std::filesystem::path& file);
/// The same of a text. @param name  what messages call it.
Result<std::vector<AvoidanceCase>> read_avoidance_cases(std::istream& in,
                                                        const std::string& name);

/// How the cases are flown.
struct AvoidanceStudy {
  std::vector<AvoidanceCase> cases;
  std::string method = "auto";
  std::string plant = "path";  ///< "path", or "fixed-wing"
  double loss = 0, delay = 0;  ///< of messages; [s]
  double range = 0;            ///< of the radio [m]; 0: no limit
  std::optional<Vec2> wind;    ///< instead of that of the cases [m/s]
  std::string turbulence = "none";
  Separation separation;
  double horizon = 90;  ///< [s]
  int seed = 1;
};

/// A run for each case.
/// Fails: kBadInput for a method or plant that does not exist, or wind as strong as an
/// airspeed.
Result<StudyPlan> plan_avoidance_study(const AvoidanceStudy& study,
                                       const scenario::KindTable& kinds);

/// The time that a flight from start to goal takes with nobody in the way [s].
double undisturbed_time(const AvoidanceAircraft& aircraft, const Vec2& wind);

/// The figures of the runs as CSV: case, method, min_ratio, min_horizontal_m, violations,
/// nmac, lowc (pairs of aircraft), extra_time_s, extra_percent (mean over those that
/// arrived), worst_extra_percent, arrived, messages, bytes, worst_decision_ms,
/// least_fixed_before_s, conflicts, deals.
std::string avoidance_csv(const AvoidanceStudy& study, const StudyPlan& plan,
                          const std::vector<BatchOutcome>& outcomes);

/// The same by kind of case (its name without what follows the last dash): sums of
/// violations, means and worst of the rest.
record::StudyTable avoidance_table(const StudyPlan& plan,
                                   const std::vector<BatchOutcome>& outcomes);

}  // namespace skein::campaign
