// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "skein/solve/path/airspace_map.h"
#include "skein/solve/path/link.h"

namespace skein::solve {

/// Counts what a planner looks at against its budget.
class SearchBudget {
 public:
  explicit SearchBudget(const PlanningBudget& budget) : budget_(&budget) {}

  /// Counts expansions; false when the budget has ended.
  bool spend(std::int64_t expansions = 1);
  bool ended() const { return ended_; }
  std::int64_t expansions() const { return expansions_; }
  std::int64_t left() const { return budget_->expansions - expansions_; }

  /// From now on there is a path: `enough` ends the search.
  void has_path() { has_path_ = true; }
  /// The budget of a part of the search: of the expansions that are left, the `share`-th
  /// part.
  PlanningBudget part(std::int64_t share) const;

 private:
  const PlanningBudget* budget_;
  std::int64_t expansions_ = 0, asked_ = 0;
  bool ended_ = false, has_path_ = false;
};

/// A waypoint: a flight state, and how long to circle from there before going on.
struct Waypoint {
  FlightState at;
  double wait = 0;  ///< 0, or a full turn or more [s]
};

/// A trajectory: flight states that are joined by links, flown from a time on.
struct Trajectory {
  std::vector<Waypoint> waypoints;  ///< at least two
  std::vector<double> times;        ///< at which each is reached [s]
  double duration() const { return times.back() - times.front(); }
};

/// The trajectory through given waypoints; nothing where a link does not exist.
std::optional<Trajectory> make_trajectory(std::vector<Waypoint> waypoints,
                                          const PathQuery& query);

/// All elements of a trajectory.
FlightPlan to_flight_plan(const Trajectory& trajectory, const PathQuery& query);

/// Makes a free trajectory quicker while it stays free: leaves out waypoints and waits,
/// and moves waypoints along, across, up and down and in heading in steps that are halved
/// until `finest`, as long as anything gets better.
/// @param finest  minimum step [m]; headings change by it over the turn radius.
void improve(Trajectory& trajectory, const AirspaceMap& map, SearchBudget& budget,
             double finest = 0.5);

/// Leads a trajectory around its conflicts: where it comes into something, a waypoint is
/// put beside, above or below, whichever gets further or is quicker.
/// @param max  how many waypoints are put in.
/// @returns  a free trajectory, or nothing.
std::optional<Trajectory> swerve(Trajectory trajectory, const AirspaceMap& map,
                                 SearchBudget& budget, int max = 6);

}  // namespace skein::solve
