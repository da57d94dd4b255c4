// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/solve/path/detours.h"
#include "skein/solve/path/trajectory.h"

namespace skein::solve {

/// How finely waypoints beside a route are tried.
enum class Detail { kCoarse, kFine };

/// A trajectory along a route around circles that a real aircraft can fly: beside each
/// arc some waypoints are offered, further out or turned. Places may be passed by.
/// - Coarse: of all trajectories through one waypoint per place the quickest that is
///   free, place by place in the order of earliest arrival.
/// - Fine: the first that a best-first search finds, which weighs the time left by 3.
/// @returns  a free trajectory, or nothing.
/// Cost: of n waypoints per place at most 2 n^2 links per place; fine mostly a small
///       part.
std::optional<Trajectory> follow_detour(const Detour& detour, const AirspaceMap& map,
                                        SearchBudget& budget, Detail detail);

}  // namespace skein::solve
