#pragma once

#include <span>
#include <vector>

#include "geo/vec.h"

namespace skein::geo {

/// A closed line: the last point joins the first, which is not repeated. Positive rings
/// (outer boundaries) run clockwise on the map, that is with growing bearing; holes run
/// the other way.
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

/// The outward unit normal of a positive ring's edge with direction `tangent`.
Vec2 outward_normal(const Vec2& tangent);

/// Points along the ring at equal arc length, `count` of them, starting at ring[0].
Ring resample(std::span<const Vec2> ring, int count);
/// Points along the ring no further than `spacing` [m] apart, at least `least`.
Ring resample_by_spacing(std::span<const Vec2> ring, double spacing, int least = 3);

struct NearestPoint {
  Vec2 point;        ///< on the boundary
  double distance;   ///< [m]
  int ring = 0;      ///< index of the ring
  int edge = 0;      ///< edge from point `edge` to the next
  double along = 0;  ///< position on the edge, 0 to 1
};

/// Answers "how far is the boundary" for many points: edges sorted into square cells.
class BoundaryIndex {
 public:
  /// Keeps a copy of the edges. An empty region is allowed: see nearest().
  explicit BoundaryIndex(const Region& region);

  bool empty() const { return edges_.empty(); }
  /// The nearest boundary point. Fails: Bug when the region is empty.
  /// Cost: about constant near the boundary.
  NearestPoint nearest(const Vec2& p) const;
  /// Distance to the boundary [m], negative inside. Fails: Bug when empty.
  double signed_distance(const Vec2& p) const;
  bool contains(const Vec2& p) const;

 private:
  struct Edge {
    Vec2 a, b;
    int ring, edge;
  };
  int cell_x(double x) const;
  int cell_y(double y) const;

  std::vector<Edge> edges_;
  Vec2 low_ = Vec2::Zero(), high_ = Vec2::Zero();
  double cell_ = 1;
  int nx_ = 0, ny_ = 0;
  std::vector<int> start_;      // per cell, into members_
  std::vector<int> members_;    // edge indices by cell
  std::vector<int> row_start_;  // per row of equal x cell, into row_members_
  std::vector<int> row_members_;
};

}  // namespace skein::geo
