// SPDX-License-Identifier: Apache-2.0
#include "skein/model/levelset/spline_field.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace skein::model {
namespace {

// Index of the first of four coefficients on one axis, and their weights.
struct Weights {
  int first;
  std::array<float, 4> w;
};

Weights weights(double position) {
  const double cell = std::floor(position);
  const auto t = static_cast<float>(position - cell);
  const float s = 1 - t;
  constexpr float kSixth = 1.0F / 6;
  return {static_cast<int>(cell) - 1,
          {kSixth * s * s * s, kSixth * (4 - 6 * t * t + 3 * t * t * t),
           kSixth * (4 - 6 * s * s + 3 * s * s * s), kSixth * t * t * t}};
}

}  // namespace

SplineStencil spline_stencil(const Grid& nodes, const Vec2& p) {
  const Weights x = weights((p.x() - nodes.low.x()) / nodes.cell);
  const Weights y = weights((p.y() - nodes.low.y()) / nodes.cell);
  SplineStencil at{{}, {}, x.w, y.w};
  for (int k = 0; k < 4; ++k) {
    const auto n = static_cast<std::size_t>(k);
    at.row[n] = nodes.index(std::clamp(x.first + k, 0, nodes.rows - 1), 0);
    at.column[n] =
        static_cast<std::size_t>(std::clamp(y.first + k, 0, nodes.columns - 1));
  }
  return at;
}

double SplineField::sample(const SplineStencil& at) const {
  float sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const float* row = coefficients.values.data() + at.row[i];
    float line = 0;
    for (std::size_t j = 0; j < 4; ++j) line += at.column_weight[j] * row[at.column[j]];
    sum += at.row_weight[i] * line;
  }
  return static_cast<double>(sum);
}

void SplineField::add_to(Field& out, float factor) const {
  const Grid& grid = coefficients.grid;
  const Grid& fine = out.grid;
  std::vector<Weights> column_weights;
  column_weights.reserve(static_cast<std::size_t>(fine.columns));
  for (int c = 0; c < fine.columns; ++c)
    column_weights.push_back(
        weights((fine.low.y() + fine.cell * c - grid.low.y()) / grid.cell));

  // One row of coefficients interpolated along north, padded so that every four exist.
  const auto padding = std::size_t{2};
  std::vector<float> line(static_cast<std::size_t>(grid.columns) + 2 * padding);
  for (int r = 0; r < fine.rows; ++r) {
    const Weights x = weights((fine.low.x() + fine.cell * r - grid.low.x()) / grid.cell);
    for (std::size_t k = 0; k < line.size(); ++k) {
      const int column = std::clamp(static_cast<int>(k) - static_cast<int>(padding), 0,
                                    grid.columns - 1);
      float sum = 0;
      for (int i = 0; i < 4; ++i)
        sum += x.w[static_cast<std::size_t>(i)] *
               coefficients.at(std::clamp(x.first + i, 0, grid.rows - 1), column);
      line[k] = factor * sum;
    }
    float* target = out.values.data() + fine.index(r, 0);
    for (std::size_t c = 0; c < column_weights.size(); ++c) {
      const Weights& y = column_weights[c];
      const int first = std::clamp(y.first + static_cast<int>(padding), 0,
                                   static_cast<int>(line.size()) - 4);
      const float* v = line.data() + first;
      target[c] += y.w[0] * v[0] + y.w[1] * v[1] + y.w[2] * v[2] + y.w[3] * v[3];
    }
  }
}

}  // namespace skein::model
