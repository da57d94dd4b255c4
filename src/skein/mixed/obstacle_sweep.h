// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "skein/base/time.h"
#include "skein/data/airspace/zone.h"
#include "skein/data/vehicle/vehicle_request.h"
#include "skein/geo/vec.h"
#include "skein/role/terrain.h"

namespace skein::mixed {

/// What stands around a place at its altitude: terrain that is as high, and no-fly zones,
/// which are walls.
///
/// Looks level along each direction of ObstacleDistances. Terrain is sampled each 2 m, or
/// 64 times along a longer line, then the place where it rises above the altitude is
/// closed in on: a hill that is narrower may be overlooked. Walls are exact.
/// @param heading  of the first direction [rad].
/// @param zones    those that forbid the altitude at `now` count.
/// @param range    looked so far [m].
/// Cost: 72 * 64 heights and as many sections as zones have corners, at most.
ObstacleDistances sweep(const Terrain& terrain, std::span<const Zone> zones,
                        const Vec3& p_N, double heading, Time now, double range);

}  // namespace skein::mixed
