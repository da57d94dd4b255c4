// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "skein/model/levelset/field.h"

namespace skein::model {

/// The coefficients around a point and their weights: good for all fields over the same
/// nodes.
struct SplineStencil {
  std::array<std::size_t, 4> row{};     ///< index of the first node of each row
  std::array<std::size_t, 4> column{};  ///< behind that
  std::array<float, 4> row_weight{}, column_weight{};
};
SplineStencil spline_stencil(const Grid& nodes, const Vec2& p);

/// A smooth field over a coarse grid: tensor product of uniform cubic B-splines, one
/// coefficient per node. The coefficients' grid must reach one node beyond the points
/// asked for; outside, the nearest coefficients count.
///
/// Independent coefficients of variance 1 give a random field of variance about 0.23
/// (see kWhiteSd) whose correlation falls as exp(-d^2 / (2 (0.82 spacing)^2)), nearly.
struct SplineField {
  Field coefficients;

  /// Standard deviation of the field with independent standard normal coefficients,
  /// averaged over the plane: the mean of the squared basis over one cell, per axis
  /// 151/315.
  static constexpr double kWhiteSd = 151.0 / 315.0;

  double sample(const Vec2& p) const {
    return sample(spline_stencil(coefficients.grid, p));
  }
  /// At the point of a stencil of its own nodes.
  double sample(const SplineStencil& at) const;

  /// Adds `factor` times the field to the nodes of `out`, whose spacing divides this
  /// one's. Cost: four multiplications per node.
  void add_to(Field& out, float factor) const;
};

}  // namespace skein::model
