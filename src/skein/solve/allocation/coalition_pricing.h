// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "skein/solve/allocation/coalitions.h"

namespace skein::solve {

/// Whether an aircraft may or must be a member of a task's group.
enum class Membership : std::uint8_t { kFree, kMust, kNever };

/// A group under prices of its members.
struct PricedGroup {
  double worth = 0;  ///< satisfaction - costs - prices
  double bound = 0;  ///< no allowed group is worth more; above `worth` only where the
                     ///< search was cut off
  std::vector<std::uint32_t> members;  ///< ascending
};

/// The group that is worth most under prices.
///
/// Sums: a search over the members that cost something, by what they bring for it, each
/// node bounded by the relaxation in which a part of a member may join. Best: one leader
/// and whoever costs less than nothing.
///
/// @param price       by aircraft, any sign.
/// @param membership  by aircraft.
PricedGroup best_group(const CoalitionTask& task, const std::vector<double>& price,
                       const std::vector<Membership>& membership);

}  // namespace skein::solve
