// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "skein/geo/polygon.h"

namespace skein::geo {

/// The region where a sampled field is below a level, by marching squares.
///
/// The field is given at the nodes of a regular grid; node (row, column) stands at
/// `low + spacing * (row, column)`, rows along north, columns along east. Between an
/// inside node (value < level) and an outside neighbour the boundary cuts the edge where
/// linear interpolation meets the level. Where it cuts all four edges of a cell, the
/// value at the saddle of the bilinear interpolant decides which corners are joined, so
/// the rings enclose what bilinear interpolation calls inside, up to a part of a cell.
/// Outside the grid nothing is inside: rings close along the outermost nodes.
///
/// @param values  rows * columns of them, index row * columns + column. -infinity is
///                inside; +infinity and NaN are outside. Next to a value that is not
///                finite the boundary cuts the edge in the middle.
/// @param spacing between nodes [m], above 0.
/// @returns closed rings, outer ones positive, holes negative, in a defined order: none
///          touches or crosses itself or another one. Rings without area are left out.
/// Fails:   Bug when the sizes do not match.
/// Cost:    linear in the nodes; one byte per node.
/// Reference: [Nielson91] for the saddle.
Region contour(std::span<const double> values, int rows, int columns, const Vec2& low,
               double spacing, double level);

}  // namespace skein::geo
