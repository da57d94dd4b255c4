// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "skein/geo/local_frame.h"
#include "skein/geo/polygon.h"

namespace skein::geo {

/// A point of what was cut at 180 degrees of longitude.
struct CutPoint {
  Geodetic at;             ///< its longitude is 180 or -180 where it was cut
  std::size_t before = 0;  ///< the last given point up to it
  double share = 0;        ///< of the way from that to the next given point, below 1
};

/// A line in parts none of which crosses 180 degrees of longitude, as RFC 7946 3.1.9
/// asks.
///
/// Two given points are joined by a straight line of the plane, and cut points lie on it:
/// what is written so and read back is the same line. Each part begins where the one
/// before ends, at the other sign of 180 degrees.
///
/// @param points  two or more in the plane of `frame` [m].
/// @returns       one part or more, of two points or more. One part where nothing
///                crosses.
std::vector<std::vector<CutPoint>> cut_line(std::span<const Vec2> points,
                                            const LocalFrame& frame);

/// A polygon in longitude and latitude: its outer ring first, then its holes; rings run
/// as in the plane and do not repeat their first point.
using PlacePolygon = std::vector<std::vector<Geodetic>>;

/// A clean region in polygons none of which crosses 180 degrees of longitude, as
/// RFC 7946 3.1.9 asks; cut as lines are. Parts below a square centimetre are left out.
/// Not cut: a region that surrounds a pole.
std::vector<PlacePolygon> cut_region(const Region& region, const LocalFrame& frame);

}  // namespace skein::geo
