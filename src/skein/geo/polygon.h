// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "skein/geo/vec.h"

namespace skein::geo {

/// A closed line: the last point joins the first, which is not repeated. Positive rings
/// (outer boundaries) run clockwise on the map, that is with growing bearing; holes run
/// counter-clockwise.
using Ring = std::vector<Vec2>;

/// A part of the plane: outer rings positive, holes negative, no two crossing.
using Region = std::vector<Ring>;

/// Signed area [m^2]: positive for a ring that runs clockwise on the map.
double signed_area(std::span<const Vec2> ring);
double area(const Region& region);
double length(std::span<const Vec2> ring);
double length(const Region& region);

/// Whether `p` is inside, by the even-odd rule. Cost: linear in the points.
bool contains(std::span<const Vec2> ring, const Vec2& p);
bool contains(const Region& region, const Vec2& p);

/// Whether the ray from `p` towards growing east crosses the edge from `a` to `b`. A
/// point is inside when an odd number of edges is crossed; every point of the plane is
/// inside exactly one of the parts into which edges divide it, those on an edge included.
bool ray_crosses(const Vec2& a, const Vec2& b, const Vec2& p);

/// The outward unit normal of a positive ring's edge with direction `tangent`.
Vec2 outward_normal(const Vec2& tangent);

/// Points along the ring at equal arc length, `count` of them, starting at ring[0].
Ring resample(std::span<const Vec2> ring, int count);
/// Points along the ring no further than `spacing` [m] apart, at least `min`.
Ring resample_by_spacing(std::span<const Vec2> ring, double spacing, int min = 3);

}  // namespace skein::geo
