// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/exchange/gis/map_features.h"
#include "skein/geo/local_frame.h"

namespace skein::exchange {

/// Reads a `.plan` of QGroundControl (versions of 2017 on): fences with their sense (of
/// the first version too, a single polygon to stay in), circles as points with radius_m,
/// surveys, corridors, rally points, and as one route all places that are flown through,
/// in their order: waypoints, splines, loiters, take-off, landing and its pattern. See
/// MapFeature::purpose.
///
/// @param place     of the text, for messages.
/// @param warnings  gets one line for all items that have no place of their own to fly
///                  to.
/// Fails: kBadInput for text that is no such plan (an older .mission among them), and for
///        places that are no latitude and longitude or over 1000 km from the origin.
Result<std::vector<MapFeature>> read_ground_plan(std::string_view text,
                                                 const std::string& place,
                                                 const geo::LocalFrame& frame,
                                                 std::vector<std::string>& warnings);

}  // namespace skein::exchange
