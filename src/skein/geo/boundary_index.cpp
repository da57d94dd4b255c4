// SPDX-License-Identifier: Apache-2.0
#include "skein/geo/boundary_index.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "skein/base/check.h"

namespace skein::geo {
namespace {

constexpr std::size_t kRun = 4;  // edges in a leaf
constexpr double kFar = std::numeric_limits<double>::infinity();

// A stack of nodes to visit: one sibling per level, and the last pair.
constexpr std::size_t kDeepest = 66;

}  // namespace

BoundaryIndex::BoundaryIndex(const Region& region) {
  for (std::size_t r = 0; r < region.size(); ++r)
    for (std::size_t i = 0; i < region[r].size(); ++i)
      edges_.push_back({region[r][i], region[r][(i + 1) % region[r].size()],
                        static_cast<int>(r), static_cast<int>(i)});
  leaves_ = std::bit_ceil((edges_.size() + kRun - 1) / kRun);
  boxes_.assign(2 * leaves_, {Vec2::Constant(kFar), Vec2::Constant(-kFar)});
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    Box& box = boxes_[leaves_ + i / kRun];
    box.low = box.low.cwiseMin(edges_[i].a).cwiseMin(edges_[i].b);
    box.high = box.high.cwiseMax(edges_[i].a).cwiseMax(edges_[i].b);
  }
  for (std::size_t node = leaves_ - 1; node > 0; --node) {
    const Box &left = boxes_[2 * node], &right = boxes_[2 * node + 1];
    boxes_[node] = {left.low.cwiseMin(right.low), left.high.cwiseMax(right.high)};
  }
}

NearestPoint BoundaryIndex::nearest(const Vec2& p) const {
  SKEIN_CHECK(!edges_.empty());
  const auto distance2 = [&](std::size_t node) {
    const Box& box = boxes_[node];
    return (box.low - p).cwiseMax(p - box.high).cwiseMax(0).squaredNorm();
  };
  struct Waiting {
    std::size_t node;
    double least2;
  };
  std::array<Waiting, kDeepest> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {1, 0};
  NearestPoint best{p, kFar, 0, 0, 0};
  double best2 = kFar;
  while (waiting > 0) {
    const auto [node, least2] = stack[--waiting];
    if (least2 >= best2) continue;
    if (node < leaves_) {
      Waiting near{2 * node, distance2(2 * node)};
      Waiting far{2 * node + 1, distance2(2 * node + 1)};
      if (far.least2 < near.least2) std::swap(near, far);
      if (far.least2 < best2) stack[waiting++] = far;
      if (near.least2 < best2) stack[waiting++] = near;
      continue;
    }
    const std::size_t first = (node - leaves_) * kRun;
    for (std::size_t i = first; i < std::min(first + kRun, edges_.size()); ++i) {
      const Edge& e = edges_[i];
      const Vec2 ab = e.b - e.a;
      const double l2 = ab.squaredNorm();
      const double along = l2 > 0 ? std::clamp((p - e.a).dot(ab) / l2, 0.0, 1.0) : 0.0;
      const Vec2 foot = e.a + along * ab;
      const double d2 = (p - foot).squaredNorm();
      if (d2 < best2) {
        best2 = d2;
        best = {foot, 0, e.ring, e.edge, along};
      }
    }
  }
  best.distance = std::sqrt(best2);
  return best;
}

bool BoundaryIndex::contains(const Vec2& p) const {
  std::array<std::size_t, kDeepest> stack;
  std::size_t waiting = 0;
  stack[waiting++] = 1;
  bool inside = false;
  while (waiting > 0) {
    const std::size_t node = stack[--waiting];
    const Box& box = boxes_[node];
    if (p.x() < box.low.x() || p.x() > box.high.x() || p.y() > box.high.y()) continue;
    if (node < leaves_) {
      stack[waiting++] = 2 * node;
      stack[waiting++] = 2 * node + 1;
      continue;
    }
    const std::size_t first = (node - leaves_) * kRun;
    for (std::size_t i = first; i < std::min(first + kRun, edges_.size()); ++i)
      if (ray_crosses(edges_[i].a, edges_[i].b, p)) inside = !inside;
  }
  return inside;
}

double BoundaryIndex::signed_distance(const Vec2& p) const {
  const double distance = nearest(p).distance;
  return contains(p) ? -distance : distance;
}

}  // namespace skein::geo
