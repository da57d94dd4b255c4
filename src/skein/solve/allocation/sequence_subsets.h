// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "skein/solve/allocation/sequence_schedule.h"

namespace skein::solve {

inline constexpr std::size_t kMaxSubsetTasks = 14;

/// Whether the dynamic program over subsets answers it: no relation between tasks, and of
/// discounted values no windows either, since then the later part of a route counts the
/// same whenever it begins, up to a factor.
bool can_be_done_by_subsets(const SequenceTable& table);

/// The best routes by dynamic programming. For each aircraft the soonest end of each
/// subset S by its last task (of kDiscounted the highest value by its first),
///
///   end(S, t) = service_t + max(opens_t, min over s in S of end(S - t, s) + leg(s, t)),
///
/// then over aircraft best_a(S) = min over R in S of max(best_(a-1)(S - R), end_a(R)), of
/// the other objectives the sum.
///
/// @returns  routes; empty when no order keeps the windows.
/// Cost:     2^n n^2 + 3^n for each aircraft.
/// Reference: [Held62].
std::optional<SequenceRoutes> best_by_subsets(const SequenceTable& table,
                                              std::int64_t& iterations);

}  // namespace skein::solve
