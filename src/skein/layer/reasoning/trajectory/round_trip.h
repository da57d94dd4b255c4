// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skein/data/airspace/zone.h"
#include "skein/data/vehicle/autopilot.h"

namespace skein::reasoning {

/// Points flown one after the other, lap after lap, at one altitude [m]. Points that
/// follow one another at the same place are one point.
///
/// @param points  at least one.
FlyWaypoints round_trip(const std::vector<Vec2>& points, int laps, double altitude_msl);

/// Where the straight lines from each point to the next first lead into a zone; nothing
/// when they stay outside. Exact for straight lines.
///
/// @param closed  the line from the last point to the first counts too.
std::optional<Vec2> into_zone(std::span<const Vec2> points, bool closed,
                              std::span<const Zone> zones);

/// Distance of a straight line from a to b to what a ring surrounds [m]; 0 when it leads
/// into it.
double distance_between(const Vec2& a, const Vec2& b, const geo::Ring& ring);

}  // namespace skein::reasoning
