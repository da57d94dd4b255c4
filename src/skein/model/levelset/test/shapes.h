// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "skein/geo/contour.h"
#include "skein/model/levelset/field.h"

namespace skein::model {

/// A square grid over [-half, half]^2 with the values of `f(p)`.
template <class Function>
Field field_of(double half, double cell, const Function& f) {
  const int nodes = static_cast<int>(std::lround(2 * half / cell)) + 1;
  Field field{{Vec2(-half, -half), cell, nodes, nodes}, {}};
  for (int row = 0; row < nodes; ++row)
    for (int column = 0; column < nodes; ++column)
      field.values.push_back(static_cast<float>(f(field.grid.node(row, column))));
  return field;
}

inline geo::Region inside_of(const Field& phi) {
  const std::vector<double> values(phi.values.begin(), phi.values.end());
  return geo::contour(values, phi.grid.rows, phi.grid.columns, phi.grid.low,
                      phi.grid.cell, 0);
}

/// Largest | |p| - radius | over the points of the zero contour.
inline double circle_error(const Field& phi, double radius) {
  double worst = 0;
  for (const geo::Ring& ring : inside_of(phi))
    for (const Vec2& p : ring) worst = std::max(worst, std::abs(p.norm() - radius));
  return worst;
}

}  // namespace skein::model
