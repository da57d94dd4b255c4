// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "skein/geo/vec.h"

namespace skein::model {

/// A regular square grid of nodes in the local plane. Node (row, column) stands at
/// `low + cell * (row, column)`: rows along north, columns along east.
struct Grid {
  Vec2 low = Vec2::Zero();  ///< position of node (0, 0) [m]
  double cell = 1;          ///< spacing of the nodes [m], above 0
  int rows = 0;
  int columns = 0;

  std::size_t size() const {
    return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  }
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  Vec2 node(int row, int column) const { return low + cell * Vec2(row, column); }
  Vec2 high() const { return node(rows - 1, columns - 1); }
  friend bool operator==(const Grid&, const Grid&) = default;
};

/// A value at every node of a grid, in the order of Grid::index().
struct Field {
  Grid grid;
  std::vector<float> values;

  float& at(int row, int column) { return values[grid.index(row, column)]; }
  float at(int row, int column) const { return values[grid.index(row, column)]; }
};

/// The four nodes around a point and their bilinear weights. Outside the grid the point
/// is moved to the nearest point of the grid. The grid needs two rows and columns.
struct Stencil {
  std::size_t corner = 0;                    ///< index of the south-west node
  std::size_t stride = 0;                    ///< to the node north of it
  float w00 = 0, w01 = 0, w10 = 0, w11 = 0;  ///< weights: first digit north, second east
  float fx = 0, fy = 0;                      ///< position in the square, 0 to 1

  double value(const std::vector<float>& v) const {
    return static_cast<double>(w00 * v[corner] + w01 * v[corner + 1] +
                               w10 * v[corner + stride] + w11 * v[corner + stride + 1]);
  }
};
Stencil stencil(const Grid& grid, const Vec2& p);

/// Bilinear interpolation at `p`; see Stencil for points outside the grid.
double sample(const Field& field, const Vec2& p);

/// Gradient [1/m of the field's unit] of the bilinear interpolant of central differences
/// over two cells around `p`; smoother than the derivative of sample().
Vec2 gradient(const Field& field, const Vec2& p);

/// The same level set on a larger grid with the same nodes: `south`, `west`, `north` and
/// `east` more rows or columns. New nodes get the value of the nearest old node plus the
/// distance to it: right in sign when the front stays within the old grid, a distance
/// after reinitialise().
Field extended(const Field& phi, int south, int west, int north, int east);

/// Every second node of `field`: the same low corner, twice the spacing. Rows and columns
/// must be odd, so that the high corner stays a node too (Bug otherwise).
Field coarsened(const Field& field);

}  // namespace skein::model
