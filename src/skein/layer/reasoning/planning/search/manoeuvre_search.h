#pragma once

#include <optional>

#include "skein/layer/reasoning/planning/search/trajectory.h"

namespace skein::planning {

/// One round of accelerated A*.
struct SearchRound {
  double finest = 0.5;          ///< least step, in turn radii
  double heuristic_weight = 1;  ///< weight of the time left: above 1 sooner, not the best
  double better = 1e300;        ///< only paths that take less are wanted [s]
  bool first = true;            ///< end with the first path
  std::int64_t states = 1'000'000;  ///< to be looked at in this round
};

/// How it ended.
struct SearchResult {
  std::optional<Trajectory> trajectory;  ///< the quickest found; free
  bool exhausted = false;                ///< there is nothing left to look at
};

/// Accelerated A* over elementary manoeuvres: straight on, turns left and right, each
/// level, climbing and sinking where altitude matters, and a full turn where time does.
///
/// - The step of a manoeuvre grows with the room around its begin, from `finest` turn
///   radii to eight.
/// - The time left is estimated by the link to the goal (`min_time`). A state whose
///   link is free ends its branch: no other way on from it is quicker.
/// - A new state is linked with the ancestors of its parent as long as that is free.
/// - States whose position and heading differ by less than a tolerance that is a part of
///   their step (and whose times do where something depends on it) are the same; the
///   earlier one is kept.
///
/// Reference: [Selecky18] ch. 8.
SearchResult search_manoeuvres(const AirspaceMap& map, const SearchRound& obstacle,
                               SearchBudget& budget);

}  // namespace skein::planning
