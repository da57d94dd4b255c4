// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/data/vehicle/vehicle.h"

namespace skein {

class Terrain;
struct Airspace;

/// How much work a planner may do.
struct PlanningBudget {
  /// Expansions it may make. What is simulated uses this limit only: it does not depend
  /// on the machine.
  std::int64_t expansions = 100'000;
  /// Asked now and then; true ends the search, with or without a path: nobody waits for
  /// it any more.
  std::function<bool()> stop = {};
  /// Asked now and then; true ends the search as soon as there is a path, or after
  /// `first_expansions` without one. For a limit of time: a machine under load
  /// gives a worse path then, never none.
  std::function<bool()> enough = {};
  std::int64_t first_expansions = 100'000;
  /// End with the first path found, without bettering it.
  bool first = false;

  /// Whether `stop` or `enough` end a search without a path after so many expansions.
  bool ends_at(std::int64_t looked_at) const {
    return (stop && stop()) || (enough && looked_at >= first_expansions && enough());
  }
};

/// What a planner is asked.
struct PathQuery {
  FlightState start, goal;
  double start_time = 0;        ///< on the run's clock [s]
  FlightLimits limits;          ///< airspeed, turn radius, climb and sink rate count
  Vec2 wind = Vec2::Zero();     ///< velocity of the air over ground [m/s]
  double ground_clearance = 0;  ///< to keep above the ground [m]
  const Airspace* airspace = nullptr;  ///< none: no obstacles
  const Terrain* terrain = nullptr;    ///< none: no ground
  /// The area that may be flown over, as corners south-west and north-east; outside of it
  /// nothing is known.
  Vec2 south_west = Vec2::Constant(-std::numeric_limits<double>::infinity());
  Vec2 north_east = Vec2::Constant(std::numeric_limits<double>::infinity());
  PlanningBudget budget;
};

/// How planning ended.
enum class PlanningOutcome : std::uint8_t {
  /// A path: near its bound, the shortest of its kind, or nothing is left to look at.
  kFound,
  kBudgetEnded,    ///< a path, the best so far; `bound` says how good it must be
  kNoPath,         ///< none was found, and nothing is left to look at; `reason` says more
  kNothingFound,   ///< the budget ended before the first path
  kStartBlocked,   ///< the start is in a zone, in the ground or in another's room
  kGoalBlocked,    ///< the goal is, whenever it can be reached
  kOutsideMap,     ///< start or goal lies outside of the area
  kWindTooStrong,  ///< at or above the airspeed
  kBadQuery,       ///< something is not a number, or not positive
};

/// The word for an outcome, as files and messages have it.
constexpr std::string_view name_of(PlanningOutcome outcome) {
  constexpr std::string_view kNames[] = {
      "found",        "budget-ended", "no-path",         "nothing-found", "start-blocked",
      "goal-blocked", "outside-map",  "wind-too-strong", "bad-query"};
  return kNames[static_cast<std::size_t>(outcome)];
}

/// What a planner answers.
struct PlannedPath {
  PlanningOutcome outcome = PlanningOutcome::kBadQuery;
  std::string reason = {};  ///< what is wrong, for people; empty when there is nothing
  FlightPlan plan;          ///< empty when there is no path
  double duration = std::numeric_limits<double>::infinity();  ///< of the plan [s]
  /// No path of bounded curvature is quicker than this [s].
  double bound = 0;
  std::int64_t expansions = 0;  ///< that it took
  /// Near a blocked start or goal, the nearest place found that is not.
  std::optional<FlightState> alternative = std::nullopt;
};

/// Finds paths from one flight state to another, around obstacles.
///
/// Holds options only: one planner may serve many aircraft and threads.
class PathPlanner {
 public:
  virtual ~PathPlanner() = default;

  virtual PlannedPath plan(const PathQuery& query) const = 0;
};

}  // namespace skein
