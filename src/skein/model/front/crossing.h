// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "skein/geo/polygon.h"

namespace skein::model {

/// Whether the open segments a-b and c-d cross in one point.
bool segments_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

/// Cuts off the small loops that a front throws where it folds onto itself (a bay that
/// closes, a notch between two merged fronts): of edges up to 8 apart that cross, the
/// markers between give way to the crossing point. That is what the positive fill rule
/// gives there, at a small part of its cost. Rings below 16 points stay as they are.
///
/// @param min_area  loops that enclose more [m^2] stay.
void cut_loops(geo::Ring& ring, double min_area);

/// Finds out whether any edges of a region cross; keeps its tables between calls.
class CrossingSearch {
 public:
  /// @param cell  about twice the usual edge length [m].
  /// Cost: about linear in the edges when few are longer than a cell.
  bool any(const geo::Region& region, double cell);

 private:
  struct Entry {
    Vec2 a, b;
    std::int64_t cell;  // both indices of the cell in one number
    std::int32_t ring, edge, last_edge;
    std::int32_t next;  // with the same hash; -1 ends
  };
  std::vector<std::int32_t> heads_;
  std::vector<Entry> entries_;
};

}  // namespace skein::model
