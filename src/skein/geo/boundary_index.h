// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/geo/polygon.h"

namespace skein::geo {

struct NearestPoint {
  Vec2 point;        ///< on the boundary
  double distance;   ///< [m]
  int ring = 0;      ///< index of the ring
  int edge = 0;      ///< edge from point `edge` to the next
  double along = 0;  ///< position on the edge, 0 to 1
};

/// Answers "how far is the boundary" and "is this inside" for many points.
///
/// A tree of bounding boxes over runs of consecutive edges: what follows each other along
/// a ring lies close together, so nothing has to be sorted.
class BoundaryIndex {
 public:
  /// Keeps a copy of the edges. An empty region is allowed: see nearest().
  /// Cost: linear in the points.
  explicit BoundaryIndex(const Region& region);

  bool empty() const { return edges_.empty(); }
  /// The nearest boundary point. Fails: Bug when the region is empty.
  /// Cost: about logarithmic in the points, wherever `p` is.
  NearestPoint nearest(const Vec2& p) const;
  /// Distance to the boundary [m], negative inside. Fails: Bug when empty.
  double signed_distance(const Vec2& p) const;
  /// By the even-odd rule. Cost: about logarithmic in the points.
  bool contains(const Vec2& p) const;

 private:
  struct Edge {
    Vec2 a, b;
    int ring, edge;
  };
  struct Box {
    Vec2 low, high;
  };

  std::vector<Edge> edges_;
  std::size_t leaves_ = 1;  // a power of 2; leaf k holds edges from k * kRun on
  std::vector<Box> boxes_;  // [1] all; [i] is over [2 i] and [2 i + 1]; leaves last
};

}  // namespace skein::geo
