// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/role/path_planner.h"

namespace skein::solve {

/// How a patrol goes around the corners of its line.
enum class PatrolCorners : std::uint8_t {
  kRounded,    ///< cut or swung out by no more than a tolerance, flown over where
               ///< impossible
  kFlownOver,  ///< the whole line is flown over; a turn back to it follows each corner
};

/// A line to be inspected: a pipe, a power line, a fence.
struct PatrolQuery {
  std::vector<Vec2> line;  ///< 2 points or more, neighbours apart [m]
  bool closed =
      false;  ///< the last point joins the first: around instead of there and back
  double offset = 0;  ///< of the flight, to the right of the line as it is drawn [m]
  PatrolCorners corners = PatrolCorners::kRounded;
  double tolerance = 20;  ///< largest distance between line and flight at a corner [m]
  int rounds = 1;         ///< there and back, or around
  /// End of the patrol [s]: passes are flown as long as they end before, instead of
  /// rounds.
  std::optional<double> until = std::nullopt;
  double altitude_msl = 100;        ///< [m]
  double start_time = 0;            ///< [s]
  std::vector<FlightState> starts;  ///< of each aircraft
  FlightLimits limits;              ///< of each
  Vec2 wind = Vec2::Zero();         ///< velocity of the air over ground [m/s]
};

enum class PatrolOutcome : std::uint8_t {
  kPlanned,
  kNoTime,         ///< no pass ends by the time asked for; see `first_end`
  kBadLine,        ///< too few points, not finite, neighbours at one place
  kBadPatrol,      ///< offset, tolerance, rounds or a time not allowed
  kBadAircraft,    ///< limits or starts
  kWindTooStrong,  ///< at or above the airspeed
};

/// The word for an outcome, as files and messages have it.
std::string_view name_of(PatrolOutcome outcome);

/// A patrol, planned.
struct PatrolResult {
  PatrolOutcome outcome = PatrolOutcome::kBadLine;
  std::string reason = {};        ///< for people; empty when planned
  std::vector<FlightPlan> plans;  ///< of each aircraft
  std::vector<double> begins;     ///< when each is at the first point of its line [s]
  std::vector<int> passes;        ///< along the line, of each
  double round_time = 0;          ///< of one round, its turns included [s]
  double interval = 0;            ///< between aircraft at the same place [s]
  double largest_deviation = 0;   ///< between the line (offset) and the flight [m]
  int flown_over = 0;             ///< corners of a round that could not be rounded
  double first_end = 0;           ///< when the first pass of the first aircraft ends [s]
};

/// Plans a patrol along a line and offset from it.
///
/// Straights are flown exactly, heading into the wind. A corner is rounded by the exact
/// connection from d before it to d after it, with the d that saves most time while no
/// point of the flight is further than the tolerance from the line, and no point of the
/// line from the flight. The line is begun at the end that is reached first.
///
/// Several aircraft share one period: they begin round time / number apart, exactly, in
/// the order in which they can be there, by airspeed and detours (timed_flight.h).
PatrolResult plan_patrol(const PatrolQuery& query);

}  // namespace skein::solve
