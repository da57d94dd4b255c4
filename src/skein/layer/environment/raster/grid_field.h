// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "skein/geo/vec.h"

namespace skein::environment {

/// A regular grid in the local plane: node (row, column) stands at
/// `low + spacing * (row, column)`, rows along north, columns along east.
struct GridShape {
  Vec2 low = Vec2::Zero();  ///< south-west node [m]
  double spacing = 1;       ///< [m]
  int rows = 0, columns = 0;

  Vec2 node(int row, int column) const { return low + spacing * Vec2(row, column); }
  Vec2 high() const { return node(rows - 1, columns - 1); }
  std::size_t count() const {
    return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  }
};

/// The smallest grid of this spacing, from `low` on, that reaches `high`; at least 2 x 2.
GridShape grid_covering(const Vec2& low, const Vec2& high, double spacing);

/// A number at every node of a grid, in memory, read by bilinear interpolation. Reading
/// is free of allocation and locks: any number of threads may.
class GridField {
 public:
  /// @param values  shape.count() of them, index row * columns + column.
  /// Fails: Bug when the sizes do not match or the grid is smaller than 2 x 2.
  GridField(const GridShape& shape, std::vector<double> values);

  const GridShape& shape() const { return shape_; }
  std::span<const double> values() const { return values_; }
  double value(int row, int column) const {
    return values_[static_cast<std::size_t>(row) *
                       static_cast<std::size_t>(shape_.columns) +
                   static_cast<std::size_t>(column)];
  }

  /// Whether `p` lies within the outermost nodes.
  bool covers(const Vec2& p) const;
  /// Bilinear between the four nodes around `p`; outside, the value of the nearest point
  /// of the grid's edge.
  double at(const Vec2& p) const;
  /// The derivative of at() to north and east; constant steps at cell borders, 0 across
  /// the edge outside the grid.
  Vec2 gradient(const Vec2& p) const;

 private:
  struct Cell {
    std::size_t corner;  // index of the south-west node
    double north, east;  // within the cell, 0 to 1
  };
  Cell cell(const Vec2& p) const;

  GridShape shape_;
  std::vector<double> values_;
};

}  // namespace skein::environment
