// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/solve/path/trajectory.h"

namespace skein::solve {

/// A time that no flight is quicker than.
struct LowerBound {
  double time = 0;  ///< [s]; infinite when there is no flight at all
};

/// The minimum time of a point that may turn at once and keeps out of the zones that hold
/// at all times and altitudes: straights at the speed over ground along them, and arcs.
///
/// What corners are passed at (1e-5 m) and sums may be off by is taken off again.
LowerBound lower_bound(const PathQuery& query, SearchBudget& budget);

}  // namespace skein::solve
