// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/geo/polygon.h"

namespace skein::solve {

inline constexpr double kBearingStep = geo::kPi / 720;  ///< of those tried [rad]

/// The same line's bearing within half a turn [rad, [0, pi)].
double half_turn(double bearing);

/// Bearings at which the best sweep may lie [rad, [0, pi)]: in steps, along edges, along
/// and across the wind, and where the number of lines changes, on the side of fewer.
std::vector<double> bearings_to_try(const geo::Region& area, double spacing,
                                    const Vec2& wind);

}  // namespace skein::solve
