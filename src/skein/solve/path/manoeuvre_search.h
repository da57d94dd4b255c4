// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/solve/path/trajectory.h"

namespace skein::solve {

/// One pass of accelerated A*.
struct SearchPass {
  double finest = 0.5;                  ///< minimum step, in turn radii
  double heuristic_weight = 1;          ///< above 1: sooner, not the best
  double better = 1e300;                ///< only paths that take less are sought [s]
  bool first = true;                    ///< end with the first path
  std::int64_t expansions = 1'000'000;  ///< at most
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
///   link is free ends its branch: no other path on from it is quicker.
/// - A new state is linked with the ancestors of its parent as long as that is free.
/// - States whose position and heading differ by less than a tolerance that is a part of
///   their step (and whose times do where something depends on it) are the same; the
///   earlier one is kept.
///
/// Reference: [Selecky18] ch. 8.
SearchResult search_manoeuvres(const AirspaceMap& map, const SearchPass& pass,
                               SearchBudget& budget);

}  // namespace skein::solve
