// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/solve/allocation/coalitions.h"

namespace skein::solve {

/// Betters an allocation by annealing: one aircraft to another task, or two that change
/// places; temperature 0.5 to 0.001; then by polish_coalitions().
///
/// @param task      where it begins, by aircraft; replaced by the best found, never
///                  worse.
/// @param instance  which of several searches of one seed this is.
/// @returns         moves tried.
std::int64_t anneal_coalitions(const CoalitionProblem& problem, const Effort& effort,
                               std::int64_t moves, std::uint32_t instance,
                               std::vector<std::size_t>& task);

/// Betters an allocation until no aircraft that goes elsewhere, no two that change
/// places, and no one that takes the place of another who goes to a third task or stays
/// idle, raises the utility.
void polish_coalitions(const CoalitionProblem& problem, std::vector<std::size_t>& task);

}  // namespace skein::solve
