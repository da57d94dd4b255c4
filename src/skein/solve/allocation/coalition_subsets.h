// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/solve/allocation/coalitions.h"

namespace skein::solve {

/// The largest team for which best_coalitions_by_subsets() is meant.
inline constexpr std::size_t kMaxSubsetAircraft = 12;

/// The best coalitions by dynamic programming over subsets of the aircraft:
///
///   best_k(S) = max over G in S of ( u_k(G) + best_(k-1)(S without G) )
///
/// Cost: 3^N per task, some 3 ms at 12 aircraft and 6 tasks.
/// Fails: Bug above 20 aircraft.
CoalitionAnswer best_coalitions_by_subsets(const CoalitionProblem& problem);

}  // namespace skein::solve
