// SPDX-License-Identifier: Apache-2.0
#include "skein/model/levelset/field.h"

#include <algorithm>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::model {

Stencil stencil(const Grid& grid, const Vec2& p) {
  const double x = std::clamp((p.x() - grid.low.x()) / grid.cell, 0.0, grid.rows - 1.0);
  const double y =
      std::clamp((p.y() - grid.low.y()) / grid.cell, 0.0, grid.columns - 1.0);
  const int row = std::min(static_cast<int>(x), grid.rows - 2);
  const int column = std::min(static_cast<int>(y), grid.columns - 2);
  const auto fx = static_cast<float>(x - row);
  const auto fy = static_cast<float>(y - column);
  Stencil s;
  s.corner = grid.index(row, column);
  s.stride = static_cast<std::size_t>(grid.columns);
  s.w00 = (1 - fx) * (1 - fy);
  s.w01 = (1 - fx) * fy;
  s.w10 = fx * (1 - fy);
  s.w11 = fx * fy;
  s.fx = fx;
  s.fy = fy;
  return s;
}

double sample(const Field& field, const Vec2& p) {
  return stencil(field.grid, p).value(field.values);
}

Vec2 gradient(const Field& field, const Vec2& p) {
  const double h = field.grid.cell;
  const Vec2 low = field.grid.low;
  const Vec2 high = field.grid.high();
  const auto difference = [&](const Vec2& step) {
    const Vec2 a = (p - step).cwiseMax(low).cwiseMin(high);
    const Vec2 b = (p + step).cwiseMax(low).cwiseMin(high);
    const double span = (b - a).norm();
    return span > 0 ? (sample(field, b) - sample(field, a)) / span : 0.0;
  };
  return {difference({h, 0}), difference({0, h})};
}

Field extended(const Field& phi, int south, int west, int north, int east) {
  const Grid& old = phi.grid;
  Field out;
  out.grid = old;
  out.grid.low -= old.cell * Vec2(south, west);
  out.grid.rows += south + north;
  out.grid.columns += west + east;
  out.values.resize(out.grid.size());
  for (int row = 0; row < out.grid.rows; ++row)
    for (int column = 0; column < out.grid.columns; ++column) {
      const int r = std::clamp(row - south, 0, old.rows - 1);
      const int c = std::clamp(column - west, 0, old.columns - 1);
      const double away = old.cell * math::hypot(row - south - r, column - west - c);
      out.at(row, column) = phi.at(r, c) + static_cast<float>(away);
    }
  return out;
}

Field coarsened(const Field& field) {
  SKEIN_CHECK(field.grid.rows % 2 == 1 && field.grid.columns % 2 == 1, field.grid.rows,
              field.grid.columns);
  Field out;
  out.grid = {field.grid.low, 2 * field.grid.cell, (field.grid.rows + 1) / 2,
              (field.grid.columns + 1) / 2};
  out.values.reserve(out.grid.size());
  for (int row = 0; row < out.grid.rows; ++row)
    for (int column = 0; column < out.grid.columns; ++column)
      out.values.push_back(field.at(2 * row, 2 * column));
  return out;
}

}  // namespace skein::model
