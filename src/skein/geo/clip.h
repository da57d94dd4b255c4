// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/geo/polygon.h"

namespace skein::geo {

/// How overlapping and self-crossing rings are read.
enum class FillRule {
  kEvenOdd,   ///< inside where an odd number of rings surround a point
  kPositive,  ///< inside where rings wind around it clockwise (on the map) more often
  kNonZero,   ///< inside where rings wind around it at all
};

/// The same part of the plane as `rings` under `rule`, as a clean region: no crossings,
/// outer rings positive, holes negative, in a defined order. Coordinates are rounded to
/// 0.1 mm; points up to 4e7 m from the origin are allowed (Bug otherwise).
/// Reference: Vatti (1992), by the Clipper library.
Region clean(const Region& rings, FillRule rule);

/// As clean(), but rings may touch themselves or each other in points. Cost: n log n,
/// where clean() is quadratic in the points of the result.
Region clean_touching(const Region& rings, FillRule rule);

Region unite(const Region& a, const Region& b);
Region intersect(const Region& a, const Region& b);
Region subtract(const Region& a, const Region& b);

/// Everything within `distance` [m] of the rings' insides: no point nearer than that is
/// left out, and none is in that is further than distance + 2 tolerance. Corners become
/// arcs. `distance` and `tolerance` above 0.
Region grown(const Region& rings, double distance, double tolerance);

/// Area [m^2] that two sets of rings have in common, each read under `rule`. Much faster
/// than area(intersect(a, b)), because no clean region is built.
double shared_area(const Region& a, const Region& b, FillRule rule);

/// Intersection over union of two clean regions, 0 to 1; 1 when both are empty.
double iou(const Region& a, const Region& b);

}  // namespace skein::geo
