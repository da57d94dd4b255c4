// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "skein/solve/allocation/answer.h"

namespace skein::solve {

/// Places that several aircraft visit together, each in one closed tour from the first of
/// them (place 0, where all begin and end). Minimised is the longest tour.
struct TourProblem {
  std::size_t places = 0;  ///< with place 0
  std::size_t tours = 1;
  /// Cost of flying from a place to another [s or m], not negative; in wind the cost back
  /// is another one. Asked once for each pair.
  std::function<double(std::size_t from, std::size_t to)> cost;
};

struct TourAnswer {
  Quality quality;
  std::vector<std::vector<std::size_t>> tours;  ///< places in order, without place 0
};

/// Shares the places among tours so that the longest one is as short as possible.
///
/// Ruin and recreate: strings of places near each other are taken out of their tours and
/// put back one by one where a power of the lengths, the 4th to the 32nd, grows least; a
/// change is kept by simulated annealing of the longest tour. The bound is the larger of
/// the dearest place there and back and, where costs are symmetric and keep the triangle
/// inequality, the least cost of one tour over all places by the number of tours. The
/// search ends where it meets the bound.
///
/// @param effort  iterations 0: one annealing of 2.5 million; with more, another begins
///                where one ends.
/// Fails:     Bug when there is no place or no tour.
/// Cost:      2.3 us an iteration at 50 to 200 places; n^2 numbers of memory.
/// Reference: [Christiaens20] sections 4 and 5.
TourAnswer shortest_tours(const TourProblem& problem, const Effort& effort);

}  // namespace skein::solve
