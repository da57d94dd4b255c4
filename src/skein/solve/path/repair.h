// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/role/path_planner.h"
#include "skein/solve/path/airspace_map.h"

namespace skein::solve {

/// What became of an old plan.
enum class Repair : std::uint8_t {
  kKept,      ///< it is still free and the aircraft is on it
  kRejoined,  ///< it is left for a while, from now or later, and joined again
  kAnew,      ///< another path was planned
  kFailed,    ///< there is none; `path` says why
};
std::string_view name_of(Repair how);

struct RepairedPath {
  Repair how = Repair::kFailed;
  PlannedPath path;         ///< from the query's start
  double left_at = 0;       ///< kRejoined: when the old plan is left [s]
  double joined_at = 0;     ///< kRejoined: when it is joined again, new times [s]
  std::string reason = {};  ///< why the old plan could not be kept, for people
};

struct RepairOptions {
  /// How near to the plan the aircraft counts as on it [m]; over, it is joined anew.
  double on_plan = 1;
  /// A repaired path that takes this much longer than what is possible at least is
  /// compared with one planned anew.
  double worse = 0.03;
  std::int64_t expansions = 400;  ///< expansions for each try to rejoin
  std::int64_t anew = 800;  ///< expansions for planning anew, within the query's budget
};

/// A path for an aircraft that follows a plan when a new obstacle blocks it, or when it
/// has left its plan too far: what is still good of the plan is kept.
///
/// The old plan is left where the aircraft is, or later but before the conflict, and
/// joined again behind it, at a few places each; between them a path is planned with few
/// expansions. Planned anew when that fails or takes much longer than the minimum time,
/// with the query's whole budget if it finds nothing with few expansions.
///
/// @param old    the plan so far, on the run's clock.
/// @param query  start and start time are the aircraft's now; its goal is the plan's.
/// @param now    the map of the query as it is now.
RepairedPath repair(const FlightPlan& old, const PathQuery& query, AirspaceMap& now,
                    const RepairOptions& options = {});
/// The same, making the map.
RepairedPath repair(const FlightPlan& old, const PathQuery& query,
                    const RepairOptions& options = {});

/// The part of a plan between two times.
FlightPlan part_of(const FlightPlan& plan, double from, double until);

}  // namespace skein::solve
