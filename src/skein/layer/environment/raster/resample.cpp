// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/base/check.h"
#include "skein/layer/environment/raster/pixel_map.h"

namespace skein::environment {
namespace {

// Bilinear between pixel centres, over those of the four that have a value; NaN when the
// pixel that `at` lies in has none.
double sample(const PixelWindow& window, const Vec2& at) {
  const auto value = [&](int column, int row) {
    const int c = std::clamp(column - window.first_column, 0, window.columns - 1);
    const int r = std::clamp(row - window.first_row, 0, window.rows - 1);
    return window
        .values[static_cast<std::size_t>(r) * static_cast<std::size_t>(window.columns) +
                static_cast<std::size_t>(c)];
  };
  const double own =
      value(static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())));
  if (std::isnan(own)) return own;
  const Vec2 q = at - Vec2(0.5, 0.5);
  const int c = static_cast<int>(std::floor(q.x())),
            r = static_cast<int>(std::floor(q.y()));
  const double dx = q.x() - c, dy = q.y() - r;
  double sum = 0, weights = 0;
  for (const int j : {0, 1})
    for (const int i : {0, 1}) {
      const double v = value(c + i, r + j);
      const double weight = (i == 1 ? dx : 1 - dx) * (j == 1 ? dy : 1 - dy);
      if (std::isnan(v)) continue;
      sum += weight * v;
      weights += weight;
    }
  return weights > 0 ? sum / weights : own;
}

// Fills NaN nodes with the value of the nearest node that has one (4-connected rings, in
// row order within a ring).
void fill_from_nearest(const GridShape& shape, std::vector<double>& values) {
  std::vector<std::size_t> front;
  const auto columns = static_cast<std::size_t>(shape.columns);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isnan(values[i])) front.push_back(i);
  while (!front.empty()) {
    std::vector<std::size_t> next;
    for (const std::size_t i : front) {
      const auto visit = [&](bool allowed, std::size_t j) {
        if (!allowed || !std::isnan(values[j])) return;
        values[j] = values[i];
        next.push_back(j);
      };
      visit(i >= columns, i - columns);
      visit(i % columns > 0, i - 1);
      visit(i % columns + 1 < columns, i + 1);
      visit(i + columns < values.size(), i + columns);
    }
    front = std::move(next);
  }
}

}  // namespace

Result<GridField> resample(const PixelWindow& pixels, const PixelMap& map,
                           Missing missing, const std::string& place) {
  const GridShape& shape = map.shape();
  SKEIN_CHECK(shape.rows >= 2 && shape.columns >= 2, shape.rows, shape.columns);
  std::vector<double> values(shape.count(), std::numeric_limits<double>::quiet_NaN());
  std::size_t lacking = 0, i = 0;
  Vec2 first = Vec2::Zero();
  for (int r = 0; r < shape.rows; ++r)
    for (int c = 0; c < shape.columns; ++c, ++i) {
      const Vec2 at = map.pixel(r, c);
      const bool within = pixels.columns > 0 && pixels.rows > 0 && at.x() >= 0 &&
                          at.y() >= 0 && at.x() <= map.raster_columns_ &&
                          at.y() <= map.raster_rows_;
      if (within) values[i] = sample(pixels, at);
      if (!std::isnan(values[i])) continue;
      if (lacking++ == 0) first = shape.node(r, c);
    }
  if (lacking == values.size())
    return Error{
        ErrorCode::kBadInput, place,
        "has no data at all in the area, which reaches from " +
            fmt::format("north {:.0f} m, east {:.0f} m to north {:.0f} m, east "
                        "{:.0f} m of the origin",
                        shape.low.x(), shape.low.y(), shape.high().x(), shape.high().y()),
        "is the origin right?"};
  if (lacking > 0 && missing == Missing::kError)
    return Error{
        ErrorCode::kBadInput, place,
        fmt::format(
            "does not cover the area: no data at {} of {} points, the first at north "
            "{:.0f} m, east {:.0f} m of the origin",
            lacking, values.size(), first.x(), first.y()),
        "use a smaller area, or let the edge's values go on outside (outside: edge)"};
  if (lacking > 0 && missing == Missing::kNearest) fill_from_nearest(shape, values);
  return GridField(shape, std::move(values));
}

}  // namespace skein::environment
