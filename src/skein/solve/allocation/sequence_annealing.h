// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/solve/allocation/sequence_schedule.h"

namespace skein::solve {

/// Routes that are good: annealing from a greedy start. Moves: a task, or up to three in
/// a row, to another place; two tasks change places; a part of a route is turned round;
/// two routes change what follows. Tasks that come too late cost what would never be
/// worth it.
///
/// @param moves  how many are tried, unless effort.used() ends it.
/// @param made   how many were.
SequenceRoutes anneal_sequences(const SequenceTable& table, const Effort& effort,
                                std::int64_t moves, std::int64_t& made);

}  // namespace skein::solve
