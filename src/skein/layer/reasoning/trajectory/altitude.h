// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/role/terrain.h"

namespace skein::reasoning {

/// The altitude above mean sea level [m] to fly now, so that the ground ahead is cleared.
///
/// It is the largest of
/// - ground + height everywhere that the next seconds of flight can lead, turns included;
/// - ground + height further away in any direction, as far as two and a half minutes of
///   flight, less what can be climbed until then: a turn may be ordered at any time.
///
/// @param position    of the aircraft.
/// @param velocity    over ground [m/s].
/// @param height      commanded above ground [m].
/// @param climb_rate  largest [m/s].
double altitude_over(const Terrain& ground, const Vec2& position, const Vec2& velocity,
                     double height, double climb_rate);

/// The highest ground [m] on the straight lines from each point to the next and from the
/// last to the first, looked at every 50 m.
///
/// @param points  at least one.
double highest_along(const Terrain& ground, const std::vector<Vec2>& points);

}  // namespace skein::reasoning
