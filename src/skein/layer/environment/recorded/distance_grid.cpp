// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/recorded/distance_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "skein/base/check.h"

namespace skein::environment {
namespace {

struct Edge {
  Vec2 a, b;
};

double squared_distance(const Edge& edge, const Vec2& p) {
  const Vec2 ab = edge.b - edge.a;
  const double l2 = ab.squaredNorm();
  const double along = l2 > 0 ? std::clamp((p - edge.a).dot(ab) / l2, 0.0, 1.0) : 0.0;
  return (p - edge.a - along * ab).squaredNorm();
}

class Distances {
 public:
  Distances(const geo::Region& region, const GridShape& shape)
      : shape_(shape),
        nearest_(shape.count(), -1),
        squared_(shape.count(), std::numeric_limits<double>::infinity()) {
    for (const geo::Ring& ring : region)
      for (std::size_t i = 0; i < ring.size(); ++i)
        edges_.push_back({ring[i], ring[(i + 1) % ring.size()]});
    SKEIN_CHECK(!edges_.empty());
  }

  std::vector<double> run() {
    for (std::size_t e = 0; e < edges_.size(); ++e) seed(static_cast<int>(e));
    // Two passes: the second mends the few nodes that the first gave a second-best edge.
    for (int round = 0; round < 2; ++round) {
      sweep(true);
      sweep(false);
    }
    std::vector<double> result(squared_.size());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = std::sqrt(squared_[i]);
    make_inside_negative(result);
    return result;
  }

 private:
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(shape_.columns) +
           static_cast<std::size_t>(column);
  }

  void offer(int edge, int row, int column) {
    const std::size_t i = index(row, column);
    if (nearest_[i] == edge) return;
    const double d2 = squared_distance(edges_[static_cast<std::size_t>(edge)],
                                       shape_.node(row, column));
    if (d2 >= squared_[i]) return;
    squared_[i] = d2;
    nearest_[i] = edge;
  }

  // Offers an edge to the nodes around it, piece by piece so that long ones stay cheap.
  // An edge outside the grid is offered to the grid's rim.
  void seed(int e) {
    const Edge& edge = edges_[static_cast<std::size_t>(e)];
    const int pieces =
        std::max(1, static_cast<int>((edge.b - edge.a).norm() / (4 * shape_.spacing)));
    for (int k = 0; k < pieces; ++k) {
      const Vec2 a = edge.a + (edge.b - edge.a) * k / pieces;
      const Vec2 b = edge.a + (edge.b - edge.a) * (k + 1) / pieces;
      const Vec2 low = (a.cwiseMin(b) - shape_.low) / shape_.spacing;
      const Vec2 high = (a.cwiseMax(b) - shape_.low) / shape_.spacing;
      const auto limit = [](double value, int count) {
        return static_cast<int>(std::clamp(value, 0.0, count - 1.0));
      };
      const int r1 = limit(std::ceil(high.x()) + 1, shape_.rows);
      const int c1 = limit(std::ceil(high.y()) + 1, shape_.columns);
      for (int r = limit(std::floor(low.x()) - 1, shape_.rows); r <= r1; ++r)
        for (int c = limit(std::floor(low.y()) - 1, shape_.columns); c <= c1; ++c)
          offer(e, r, c);
    }
  }

  // Hands nearest edges on to the neighbours ahead, row by row and in each row in both
  // directions.
  void sweep(bool north) {
    const int step = north ? -1 : 1;  // to the row done before
    for (int k = 0; k < shape_.rows; ++k) {
      const int r = north ? k : shape_.rows - 1 - k;
      const int before = r + step;
      const auto take = [&](int c, int from_row, int from_column) {
        if (from_row < 0 || from_row >= shape_.rows || from_column < 0 ||
            from_column >= shape_.columns)
          return;
        const int edge = nearest_[index(from_row, from_column)];
        if (edge >= 0) offer(edge, r, c);
      };
      for (int c = 0; c < shape_.columns; ++c) {
        for (const int side : {-1, 0, 1}) take(c, before, c + side);
        take(c, r, c - 1);
      }
      for (int c = shape_.columns - 1; c >= 0; --c) take(c, r, c + 1);
    }
  }

  // Even-odd along every row of nodes: an edge counts when its ends lie on different
  // sides of the row, with the same half-open rule as geo::contains.
  void make_inside_negative(std::vector<double>& values) const {
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(shape_.rows));
    for (const Edge& edge : edges_) {
      const auto [south, north] = std::minmax(edge.a.x(), edge.b.x());
      const double first = std::ceil((south - shape_.low.x()) / shape_.spacing) - 1;
      for (int r = static_cast<int>(std::clamp(first, 0.0, shape_.rows - 1.0));
           r < shape_.rows; ++r) {
        const double x = shape_.low.x() + shape_.spacing * r;
        if (x > north) break;
        if ((edge.a.x() > x) == (edge.b.x() > x)) continue;
        const double part = (x - edge.a.x()) / (edge.b.x() - edge.a.x());
        crossings[static_cast<std::size_t>(r)].push_back(
            edge.a.y() + part * (edge.b.y() - edge.a.y()));
      }
    }
    for (int r = 0; r < shape_.rows; ++r) {
      auto& row = crossings[static_cast<std::size_t>(r)];
      std::sort(row.begin(), row.end());
      std::size_t passed = 0;
      for (int c = 0; c < shape_.columns; ++c) {
        const double y = shape_.low.y() + shape_.spacing * c;
        while (passed < row.size() && row[passed] <= y) ++passed;
        if (passed % 2 == 1) values[index(r, c)] = -values[index(r, c)];
      }
    }
  }

  GridShape shape_;
  std::vector<Edge> edges_;
  std::vector<int> nearest_;
  std::vector<double> squared_;
};

}  // namespace

GridField signed_distance(const geo::Region& region, const GridShape& shape) {
  return GridField(shape, Distances(region, shape).run());
}

}  // namespace skein::environment
