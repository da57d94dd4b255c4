// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "skein/data/perimeter/fire.h"
#include "skein/geo/vec.h"

namespace skein::perimeter {

/// Where an aircraft begins its transect, and the course of that.
struct Entry {
  Vec2 place = Vec2::Zero();  ///< outside of the believed boundary [m]
  double course = 0;          ///< towards the origin [rad]
};

/// Entries on evenly spaced sides of a believed boundary, one for each aircraft, so that
/// the last aircraft reaches its own as early as possible: so they meet the boundary on
/// all sides, wherever they come from. Of equally good ones, those with the shortest ways
/// together.
///
/// Ways are straight: those to the far side may lead across the fire, where they meet the
/// boundary even earlier.
/// @param origin    of the fire, within the boundary [m].
/// @param aircraft  where they are [m].
/// @returns         in the order of the aircraft.
std::vector<Entry> plan_entries(const BoundaryEstimate& boundary, const Vec2& origin,
                                std::span<const Vec2> aircraft);

}  // namespace skein::perimeter
