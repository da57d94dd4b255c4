// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "skein/data/airspace/zone.h"
#include "skein/geo/boundary_index.h"

namespace skein::reasoning {

/// Change of a clearance, as a share of it, for which detours are not drawn anew.
inline constexpr double kClearanceSlack = 0.1;

/// The places that are at least `clearance` away, a few metres more at arcs, from some
/// zones, and the short paths between them.
class DetourPlanner {
 public:
  /// @param clearance  from the border of every zone [m], above 0.
  DetourPlanner(std::span<const Zone> zones, double clearance);

  /// Whether a place may be flown to.
  bool allows(const Vec2& p) const { return border_.empty() || !border_.contains(p); }

  /// Whether the straight path stays where it is allowed.
  bool allows(const Vec2& from, const Vec2& to) const;

  /// The nearest place that may be flown to and that no zones surround; `p` itself when
  /// it is one.
  Vec2 nearest_allowed(const Vec2& p) const;

  /// The shortest path by straight lines, without its start: corners, then `to`. It
  /// begins with the nearest allowed place when the start is not allowed, and ends with
  /// that when `to` is not. When zones surround one of the two, and not the other, it is
  /// straight. Cost: a search over the corners of the zones; each looks along all sides.
  std::vector<Vec2> detour(const Vec2& from, const Vec2& to) const;

 private:
  geo::Region area_;                        // not allowed
  std::vector<Eigen::AlignedBox2d> boxes_;  // around each of its rings
  geo::BoundaryIndex border_;               // of it
  geo::BoundaryIndex outer_;                // of it and of what it surrounds
  std::vector<Vec2> corners_;               // just outside of it, where detours bend
};

}  // namespace skein::reasoning
