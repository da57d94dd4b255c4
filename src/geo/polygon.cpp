#include "geo/polygon.h"

#include <algorithm>
#include <limits>

#include "base/check.h"

namespace skein::geo {

double signed_area(std::span<const Vec2> ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    twice += cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
  return twice / 2;
}

double area(const Region& region) {
  double sum = 0;
  for (const Ring& ring : region) sum += signed_area(ring);
  return sum;
}

double length(std::span<const Vec2> ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    sum += (ring[(i + 1) % ring.size()] - ring[i]).norm();
  return sum;
}

double length(const Region& region) {
  double sum = 0;
  for (const Ring& ring : region) sum += length(std::span<const Vec2>(ring));
  return sum;
}

namespace {

// Whether the ray from p towards growing east crosses the edge.
bool ray_crosses(const Vec2& a, const Vec2& b, const Vec2& p) {
  return (a.x() > p.x()) != (b.x() > p.x()) &&
         p.y() < (b.y() - a.y()) * (p.x() - a.x()) / (b.x() - a.x()) + a.y();
}

}  // namespace

bool contains(std::span<const Vec2> ring, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    if (ray_crosses(ring[i], ring[j], p)) inside = !inside;
  return inside;
}

bool contains(const Region& region, const Vec2& p) {
  bool inside = false;
  for (const Ring& ring : region) inside ^= contains(std::span<const Vec2>(ring), p);
  return inside;
}

Vec2 outward_normal(const Vec2& tangent) {
  return turned_left(tangent.normalized());
}

Ring resample(std::span<const Vec2> ring, int count) {
  SKEIN_CHECK(count > 0 && !ring.empty(), count, ring.size());
  const double total = length(ring);
  Ring points;
  points.reserve(static_cast<std::size_t>(count));
  std::size_t i = 0;
  double walked = 0;  // arc length at ring[i]
  for (int k = 0; k < count; ++k) {
    const double target = total * k / count;
    double edge = (ring[(i + 1) % ring.size()] - ring[i]).norm();
    while (i + 1 < ring.size() && walked + edge <= target) {
      walked += edge;
      ++i;
      edge = (ring[(i + 1) % ring.size()] - ring[i]).norm();
    }
    const double along = edge > 0 ? std::clamp((target - walked) / edge, 0.0, 1.0) : 0;
    points.push_back(ring[i] + along * (ring[(i + 1) % ring.size()] - ring[i]));
  }
  return points;
}

Ring resample_by_spacing(std::span<const Vec2> ring, double spacing, int least) {
  SKEIN_CHECK(spacing > 0, spacing);
  const double wanted = std::ceil(length(ring) / spacing);
  SKEIN_CHECK(wanted < 1e8, wanted);
  return resample(ring, std::max(least, static_cast<int>(wanted)));
}

BoundaryIndex::BoundaryIndex(const Region& region) {
  for (std::size_t r = 0; r < region.size(); ++r)
    for (std::size_t i = 0; i < region[r].size(); ++i)
      edges_.push_back({region[r][i], region[r][(i + 1) % region[r].size()],
                        static_cast<int>(r), static_cast<int>(i)});
  if (edges_.empty()) return;

  low_ = high_ = edges_[0].a;
  double total = 0;
  for (const Edge& e : edges_) {
    low_ = low_.cwiseMin(e.a);
    high_ = high_.cwiseMax(e.a);
    total += (e.b - e.a).norm();
  }
  const Vec2 size = high_ - low_;
  const double count = static_cast<double>(edges_.size());
  // About one cell per edge along the boundary, and never over 4 cells per edge in all.
  cell_ = std::max({total / count, std::sqrt(size.x() * size.y() / (4 * count)), 1e-9});
  nx_ = static_cast<int>(size.x() / cell_) + 1;
  ny_ = static_cast<int>(size.y() / cell_) + 1;

  const auto cells = static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_);
  const auto for_cells = [&](const Edge& e, auto&& visit) {
    const int x0 = cell_x(std::min(e.a.x(), e.b.x())),
              x1 = cell_x(std::max(e.a.x(), e.b.x()));
    const int y0 = cell_y(std::min(e.a.y(), e.b.y())),
              y1 = cell_y(std::max(e.a.y(), e.b.y()));
    for (int x = x0; x <= x1; ++x)
      for (int y = y0; y <= y1; ++y) visit(static_cast<std::size_t>(x * ny_ + y));
  };
  const auto for_rows = [&](const Edge& e, auto&& visit) {
    const int x0 = cell_x(std::min(e.a.x(), e.b.x())),
              x1 = cell_x(std::max(e.a.x(), e.b.x()));
    for (int x = x0; x <= x1; ++x) visit(static_cast<std::size_t>(x));
  };
  const auto fill = [&](std::vector<int>& start, std::vector<int>& members,
                        std::size_t buckets, auto&& for_buckets) {
    start.assign(buckets + 1, 0);
    for (const Edge& e : edges_) for_buckets(e, [&](std::size_t c) { ++start[c + 1]; });
    for (std::size_t c = 0; c < buckets; ++c) start[c + 1] += start[c];
    members.resize(static_cast<std::size_t>(start[buckets]));
    std::vector<int> next(start.begin(), start.end() - 1);
    for (std::size_t i = 0; i < edges_.size(); ++i)
      for_buckets(edges_[i], [&](std::size_t c) {
        members[static_cast<std::size_t>(next[c]++)] = static_cast<int>(i);
      });
  };
  fill(start_, members_, cells, for_cells);
  fill(row_start_, row_members_, static_cast<std::size_t>(nx_), for_rows);
}

int BoundaryIndex::cell_x(double x) const {
  return static_cast<int>(std::clamp((x - low_.x()) / cell_, 0.0, nx_ - 1.0));
}
int BoundaryIndex::cell_y(double y) const {
  return static_cast<int>(std::clamp((y - low_.y()) / cell_, 0.0, ny_ - 1.0));
}

NearestPoint BoundaryIndex::nearest(const Vec2& p) const {
  SKEIN_CHECK(!edges_.empty());
  NearestPoint best{p, std::numeric_limits<double>::infinity(), 0, 0, 0};
  double best2 = std::numeric_limits<double>::infinity();
  const int cx = cell_x(p.x()), cy = cell_y(p.y());
  const auto visit = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= nx_ || y >= ny_) return;
    const auto cell = static_cast<std::size_t>(x * ny_ + y);
    for (int k = start_[cell]; k < start_[cell + 1]; ++k) {
      const Edge& e =
          edges_[static_cast<std::size_t>(members_[static_cast<std::size_t>(k)])];
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
  };
  // Distance from p to the far side of ring k of cells, from p's (clamped) cell.
  const Vec2 base(low_.x() + cx * cell_, low_.y() + cy * cell_);
  for (int k = 0; k <= std::max(nx_, ny_); ++k) {
    if (k > 0) {
      // Everything in ring k and beyond lies outside the square of rings below k; how
      // far p is from leaving that square bounds the distance from below.
      const double inside =
          std::min({p.x() - (base.x() - (k - 1) * cell_), base.x() + k * cell_ - p.x(),
                    p.y() - (base.y() - (k - 1) * cell_), base.y() + k * cell_ - p.y()});
      const bool p_in_grid =
          (p.array() >= low_.array()).all() && (p.array() <= high_.array()).all();
      if (p_in_grid && inside > 0 && best2 <= inside * inside) break;
      if (!p_in_grid && best2 < std::numeric_limits<double>::infinity()) {
        // Outside the grid: cells k away in both axes are at least this far from p.
        const Vec2 q = p.cwiseMax(low_).cwiseMin(high_);
        const double reach = (p - q).norm();
        const double near = (k - 1) * cell_;
        if (best2 <= reach * reach + near * near && near > 0) break;
      }
    }
    for (int x = cx - k; x <= cx + k; ++x) {
      if (x == cx - k || x == cx + k)
        for (int y = cy - k; y <= cy + k; ++y) visit(x, y);
      else {
        visit(x, cy - k);
        visit(x, cy + k);
      }
    }
  }
  best.distance = std::sqrt(best2);
  return best;
}

bool BoundaryIndex::contains(const Vec2& p) const {
  if (edges_.empty() || (p.array() < low_.array()).any() ||
      (p.array() > high_.array()).any())
    return false;
  bool inside = false;
  const auto row = static_cast<std::size_t>(cell_x(p.x()));
  for (int k = row_start_[row]; k < row_start_[row + 1]; ++k) {
    const Edge& e =
        edges_[static_cast<std::size_t>(row_members_[static_cast<std::size_t>(k)])];
    if (ray_crosses(e.a, e.b, p)) inside = !inside;
  }
  return inside;
}

double BoundaryIndex::signed_distance(const Vec2& p) const {
  const double distance = nearest(p).distance;
  return contains(p) ? -distance : distance;
}

}  // namespace skein::geo
