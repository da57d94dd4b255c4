// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/geo/vec.h"

namespace skein::campaign {

/// An aircraft of a case: it flies from a place straight to another.
struct AvoidanceAircraft {
  Vec3 start = Vec3::Zero(), goal = Vec3::Zero();  ///< p_N [m]
  double airspeed = 20;                            ///< [m/s]
};

/// An intruder of a case: it flies straight on, with at most one turn, and gives no way.
struct AvoidanceIntruder {
  Vec3 p_N = Vec3::Zero();  ///< at the start [m]
  Vec3 v_N = Vec3::Zero();  ///< over ground, at the start [m/s]
  struct Turn {
    double from = 0, duration = 0;  ///< [s]
    double rate = 0;                ///< positive to the right [rad/s]
    double climb = 0;               ///< from its begin on, up [m/s]
  };
  std::optional<Turn> turn;
};

/// Aircraft that will meet.
struct AvoidanceCase {
  std::string name;
  Vec2 wind = Vec2::Zero();  ///< velocity of the air [m/s]
  std::vector<AvoidanceAircraft> aircraft;
  std::vector<AvoidanceIntruder> intruders;
};

/// Reads cases from a CSV file; other columns are passed over.
///
/// - Of a team: `case, aircraft` (from 1), `start_north_m, start_east_m, start_down_m,
///   goal_north_m, goal_east_m, goal_down_m, airspeed_mps`, and where there is wind
///   `wind_north_mps, wind_east_mps` (velocity of the air). A row for each aircraft.
/// - With an intruder: `case, own_north_m, own_east_m, own_down_m, goal_north_m,
///   goal_east_m, own_speed_mps, int_north_m, int_east_m, int_down_m, int_vn_mps,
///   int_ve_mps, int_vd_mps, turn_from_s, turn_for_s, turn_rate_radps, climb_vd_mps` (no
///   turn where `turn_from_s` is empty). A row for each case; the own flight is level.
///
/// Fails: kBadInput with line and column; as read_file().
Result<std::vector<AvoidanceCase>> read_avoidance_cases(
    const std::filesystem::path& file);
/// The same of a text. @param name  what messages call it.
Result<std::vector<AvoidanceCase>> parse_avoidance_cases(const std::string& text,
                                                         const std::string& name);

}  // namespace skein::campaign
