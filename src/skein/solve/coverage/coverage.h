// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/data/airspace/zone.h"
#include "skein/data/vehicle/flight_plan.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/role/path_planner.h"
#include "skein/solve/coverage/watch.h"

namespace skein::solve {

/// Where one of the aircraft of a survey begins and ends. Without a start it begins on
/// its first line, without an end it ends on its last.
struct CoverageAircraft {
  std::optional<FlightState> start = std::nullopt, end = std::nullopt;
};

/// What shall be surveyed, and with what.
struct CoverageQuery {
  geo::Ring area;                ///< either direction; does not cross itself
  std::vector<geo::Ring> holes;  ///< not to be surveyed, but may be flown over
  std::vector<Zone> zones;    ///< not to be flown over; those that hold at the altitude
  double swath = 100;         ///< width that the sensor sees, half on either side [m]
  double overlap = 0;         ///< share of it that neighbouring lines have in common
  double overshoot = 0;       ///< lines begin this much earlier and end later [m]
  double zone_distance = 0;   ///< lines keep this far from zones [m]
  double altitude_msl = 100;  ///< of the lines [m]
  double start_time = 0;      ///< [s]
  FlightLimits limits;        ///< of each aircraft
  Vec2 wind = Vec2::Zero();   ///< velocity of the air over ground [m/s]
  std::vector<CoverageAircraft> aircraft = {{}};
  /// Bearing of the lines [rad]; none: the quickest.
  std::optional<double> bearing = std::nullopt;
  /// For connections that would enter a zone; none: such connections are not mended.
  const PathPlanner* planner = nullptr;
  Watch watch = {};
};

enum class CoverageOutcome : std::uint8_t {
  kPlanned,
  kZoneInTheWay,    ///< planned, but a connection enters a zone: see `in_zones`
  kNothingToCover,  ///< holes and zones leave nothing of the area
  kBadArea,         ///< fewer than 3 points, not finite, crosses itself, no area
  kBadZone,         ///< a hole or zone is so, or runs anticlockwise on the map
  kBadSwath,        ///< swath, overlap, overshoot or distance not allowed
  kBadAircraft,  ///< limits, altitude, or a start or end, are not numbers or not positive
  kWindTooStrong,  ///< at or above the airspeed
  kTooManyLines,   ///< swath too small: more than 500 lines over the area's width
  kBlocked,        ///< a start or an end lies in a zone
};

/// The word for an outcome, as files and messages have it.
std::string_view name_of(CoverageOutcome outcome);

/// A survey, planned.
struct CoverageResult {
  CoverageOutcome outcome = CoverageOutcome::kBadArea;
  std::string reason = {};        ///< for people; empty when planned
  std::vector<FlightPlan> plans;  ///< of each aircraft; empty for one that has no line
  std::vector<double> times;      ///< of each plan [s]
  /// Begin and end of each line that an aircraft flies, in its order, over ground [m].
  std::vector<std::vector<Vec2>> line_ends;
  bool stopped = false;      ///< by the watch: there may be better ones
  double longest = 0;        ///< of these: when the survey is done [s]
  double total = 0;          ///< their sum [s]
  double bearing = 0;        ///< of the lines [rad, [0, pi)]
  int lines = 0;             ///< flown
  double on_lines = 0;       ///< time on lines, of all aircraft [s]
  double area = 0;           ///< to be covered [m^2]
  double covered_share = 0;  ///< of it, beside the lines
  double in_zones = 0;       ///< time within zones [s]
  /// For a start or end in a zone, the nearest place found that is in none [m].
  std::optional<Vec2> free_place = std::nullopt;
  /// For an area that crosses itself, the same area without crossings.
  std::optional<geo::Region> alternative = std::nullopt;
};

/// Plans parallel sweeps over an area so that all aircraft are done as early as possible.
///
/// Bearings 0.25 degrees apart, and besides those of the edges, of the wind and of the
/// minimum width, are tried with a simple order of lines; the most promising ones, and
/// bearings in between, with the best order that is found (line_order.h). Over ground the
/// lines are flown exactly, heading into the wind; connections are the quickest flights.
///
/// Guarantee: without zones every point of the area lies beside a flown line, at most
/// swath (1 - overlap) / 2 from it. With zones this holds but for what `zone_distance`
/// takes, corners where there is no room to turn and gaps that are not worth a line
/// (gap_lines.h); `covered_share` says how much is seen. Lines never come nearer to a
/// zone than `zone_distance`; connections enter one only with outcome kZoneInTheWay.
CoverageResult plan_coverage(const CoverageQuery& query);

}  // namespace skein::solve
