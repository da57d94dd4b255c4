// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/solve/touring/tour_state.h"

namespace skein::solve {

/// What the longest of several closed tours costs at least, rounded downwards: the
/// dearest place alone there and back, each over any others; and, for costs that are
/// symmetric and keep the triangle inequality, the least cost of one tour over all
/// places, by the number of tours, since tours that meet in place 0 make one tour over
/// all.
///
/// The one tour is bounded by 1-trees whose nodes are given prices by ascent.
/// Reference: [Held71] section 3.
double tour_bound(const TourCosts& costs, std::size_t tours);

}  // namespace skein::solve
