// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/data/perimeter/fire.h"

namespace skein::perimeter {

/// A crossing beside a boundary that was believed before it.
struct CrossingOffset {
  double off2 = 0;      ///< squared distance [m^2]
  double variance = 0;  ///< believed, with that of the crossing itself [m^2]
  /// Squared distance over the variance, at most 25 [-]; 1 on average if honest.
  double square() const;
};

/// Compares a crossing with a boundary, carried on to the time of the crossing by its
/// rates and its deviations' growth. Nothing if no boundary was believed.
/// Cost: linear in the boundary's points.
std::optional<CrossingOffset> crossing_offset(const Crossing& crossing,
                                              const BoundaryEstimate& boundary);

}  // namespace skein::perimeter
