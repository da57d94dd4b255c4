// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/raster/grid_field.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"

namespace skein::environment {

GridShape grid_covering(const Vec2& low, const Vec2& high, double spacing) {
  SKEIN_CHECK(spacing > 0 && low.allFinite() && high.allFinite(), spacing);
  const Vec2 cells = ((high - low) / spacing).array().ceil().max(1.0).matrix();
  SKEIN_CHECK(cells.x() * cells.y() < 1e9, cells.x(), cells.y());
  return {low, spacing, static_cast<int>(cells.x()) + 1, static_cast<int>(cells.y()) + 1};
}

GridField::GridField(const GridShape& shape, std::vector<double> values)
    : shape_(shape), values_(std::move(values)) {
  SKEIN_CHECK(shape_.rows >= 2 && shape_.columns >= 2 && shape_.spacing > 0, shape_.rows,
              shape_.columns, shape_.spacing);
  SKEIN_CHECK(values_.size() == shape_.count(), values_.size());
}

bool GridField::covers(const Vec2& p) const {
  return (p.array() >= shape_.low.array()).all() &&
         (p.array() <= shape_.high().array()).all();
}

GridField::Cell GridField::cell(const Vec2& p) const {
  const Vec2 q = (p - shape_.low) / shape_.spacing;
  // A NaN position reads the first cell; its NaN then shows in the result.
  const double row = std::clamp(std::floor(q.x()), 0.0, shape_.rows - 2.0);
  const double column = std::clamp(std::floor(q.y()), 0.0, shape_.columns - 2.0);
  const auto r = static_cast<std::size_t>(row >= 0 ? row : 0);
  const auto c = static_cast<std::size_t>(column >= 0 ? column : 0);
  return {r * static_cast<std::size_t>(shape_.columns) + c,
          std::clamp(q.x() - row, 0.0, 1.0), std::clamp(q.y() - column, 0.0, 1.0)};
}

double GridField::at(const Vec2& p) const {
  const Cell c = cell(p);
  const double* south = &values_[c.corner];
  const double* north = south + shape_.columns;
  const double s = south[0] + c.east * (south[1] - south[0]);
  const double n = north[0] + c.east * (north[1] - north[0]);
  return s + c.north * (n - s);
}

Vec2 GridField::gradient(const Vec2& p) const {
  const Cell c = cell(p);
  const double* south = &values_[c.corner];
  const double* north = south + shape_.columns;
  const double to_north =
      (1 - c.east) * (north[0] - south[0]) + c.east * (north[1] - south[1]);
  const double to_east =
      (1 - c.north) * (south[1] - south[0]) + c.north * (north[1] - north[0]);
  const Vec2 high = shape_.high();
  const bool in_north = p.x() >= shape_.low.x() && p.x() <= high.x();
  const bool in_east = p.y() >= shape_.low.y() && p.y() <= high.y();
  return Vec2(in_north ? to_north : 0, in_east ? to_east : 0) / shape_.spacing;
}

}  // namespace skein::environment
