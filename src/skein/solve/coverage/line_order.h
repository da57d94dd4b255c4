// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/solve/coverage/line_costs.h"

namespace skein::solve {

/// Visits of an aircraft, one after the other.
using Route = std::vector<int>;

/// An order counts as quicker from this gain on [s].
inline constexpr double kGain = 1e-9;

/// Time of a route from the aircraft's start to its end [s]; 0 when it has no visits.
double route_time(LineCosts& costs, int aircraft, const Route& route);

/// Orders to begin with: cell by cell, nearest cell next; within a cell next line by next
/// line, or skipping so that turns are as wide as several lines (k forward, k - 1 back,
/// up to `max_skip`). The direction of each line is the best for that order (dynamic
/// programme). The quickest for one aircraft.
Route quickest_pattern(LineCosts& costs, int aircraft, int max_skip);

/// Makes a route quicker by reversing and moving parts of it until none of these steps
/// helps, then `kicks` times from a disturbed order. Never makes it slower.
/// Cost: quadratic in the lines for each step.
Route improved(LineCosts& costs, int aircraft, Route route, int kicks);

/// The quickest of all orders and directions, by dynamic programming over sets
/// ([Held62]).
/// @returns  with the lines of `route`, at most 12 (Bug otherwise).
Route quickest_order(LineCosts& costs, int aircraft, const Route& route);

/// How much work goes into an order.
struct OrderBudget {
  int max_skip = 6;
  int kicks = 20;
  int exact_up_to = 10;  ///< lines for which all orders are tried
};

/// All lines by one aircraft.
Route order_lines(LineCosts& costs, const OrderBudget& budget);

}  // namespace skein::solve
