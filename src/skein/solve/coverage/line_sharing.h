// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/solve/coverage/line_order.h"

namespace skein::solve {

/// Divides all lines among the aircraft, and orders each one's, so that the longest route
/// is short; of equally long ones, so that the sum is. One aircraft flies them all.
///
/// A good order for all lines is cut into parts (dynamic programme over the cuts); then
/// lines are moved from the longest route to others, and ends of routes exchanged, while
/// that helps.
/// @returns  one route for each aircraft; some may be empty.
std::vector<Route> share_lines(LineCosts& costs, const OrderBudget& budget);

/// The longest route when a simple order of all lines, or a better one, is only cut [s]:
/// an estimate of what share_lines finds.
double rough_longest(LineCosts& costs, const OrderBudget& budget, bool improve);

}  // namespace skein::solve
