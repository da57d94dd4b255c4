// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/result.h"
#include "skein/data/airspace/airspace.h"
#include "skein/data/airspace/zone.h"
#include "skein/exchange/gis/map_features.h"

namespace skein::exchange {

/// The no-fly zones of a map: areas, and points with `radius_m`, which are discs;
/// floor_m, ceiling_m, from_s, until_s limit them. A zone with holes becomes several that
/// overlap by 0.2 m. Features that a file of Skein's calls something else are left out,
/// and those with another purpose than an exclusion fence.
///
/// Fails: kBadInput for a ring that crosses itself (and where), a line, a point without a
///        radius, a floor above the ceiling, an end before the beginning.
Result<std::vector<Zone>> zones_of(const std::vector<MapFeature>& features);

/// How many features zones_of() takes for zones that stand still although they have a
/// property of moving obstacles: height_m, time_s, climb_mps or a velocity.
int movers_among_zones(const std::vector<MapFeature>& features);

/// The one area of a map that is to be covered, with its holes.
/// Fails: kBadInput unless there is just one, without crossings.
Result<MapFeature> area_of(const std::vector<MapFeature>& features);

/// The one line of a map that is to be patrolled; the rim of the one area of a map
/// without lines, its first point repeated at the end.
/// Fails: kBadInput unless there is just one.
Result<MapFeature> line_of(const std::vector<MapFeature>& features);

/// The moving obstacles of a map: points with radius_m, height_m, an altitude (third
/// coordinate or altitude_m) and, where they move, velocity_east_mps, velocity_north_mps,
/// climb_mps, time_s, from_s, until_s.
/// Fails: kBadInput for what is no point or lacks a property.
Result<std::vector<MovingObstacle>> movers_of(const std::vector<MapFeature>& features);

}  // namespace skein::exchange
