// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "skein/solve/allocation/sequence_schedule.h"

namespace skein::solve {

inline constexpr std::size_t kMaxOrderedTasks = 8;

/// What looking at all orders gave.
struct OrderedRoutes {
  SequenceRoutes routes;
  double cost = 0;
  bool complete = false;  ///< all orders were looked at: nothing is cheaper
  bool found = false;     ///< something that keeps windows and relations, below `limit`
};

/// Looks at all ways to do tasks in the order in which they begin, each with every
/// aircraft, as early as possible, and gives up what its bound shows to be no better.
///
/// Complete for any relations and windows: every schedule in which nothing can be earlier
/// is made of its tasks by their begins.
///
/// @param limit  only what costs less counts.
OrderedRoutes best_by_orders(const SequenceTable& table, double limit,
                             const Effort& effort, std::int64_t& iterations);

}  // namespace skein::solve
