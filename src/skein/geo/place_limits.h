// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/geo/local_frame.h"

namespace skein::geo {

/// How far from the origin a place given by latitude and longitude may lie, in scenarios,
/// map files and logs [m]. Further away it belongs to another origin.
inline constexpr double kMaxPlaceDistance = 1e6;

/// Distance along the Earth from the origin of a frame to a place, to 1 % [m]. The local
/// plane does not serve: beyond the horizon it folds back.
double distance_from_origin(const LocalFrame& frame, double latitude_deg,
                            double longitude_deg);

}  // namespace skein::geo
