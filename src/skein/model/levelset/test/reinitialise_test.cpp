// SPDX-License-Identifier: Apache-2.0
#include "skein/model/levelset/reinitialise.h"

#include <gtest/gtest.h>

#include "shapes.h"
#include "skein/geo/clip.h"

namespace skein::model::reinitialise_test {
namespace {

TEST(Reinitialise, DistortedCircleBecomesADistance) {
  // Same zero contour, gradient between 0.3 and 3.
  Field phi = field_of(200, 10, [](const Vec2& p) {
    return (p.norm() - 100) * (1.65 + 1.35 * std::sin(p.x() / 30));
  });
  reinitialise(phi);
  // The contour was moved by interpolating a bent function: a tenth of a cell. Away from
  // the centre, first-order sweeping is good to a few percent of the distance.
  EXPECT_LT(circle_error(phi, 100), 1.5);
  for (int r = 1; r + 1 < phi.grid.rows; ++r)
    for (int c = 1; c + 1 < phi.grid.columns; ++c) {
      const Vec2 p = phi.grid.node(r, c);
      if (p.norm() < 40) continue;
      EXPECT_NEAR(static_cast<double>(phi.at(r, c)), p.norm() - 100, 5) << p.transpose();
      EXPECT_NEAR(gradient(phi, p).norm(), 1, 0.15) << p.transpose();
    }
}

TEST(Reinitialise, ZeroContourStaysWhenRepeated) {
  // A C with re-entrant corners.
  Field phi = field_of(300, 10, [](const Vec2& p) {
    const double ring = std::abs(p.norm() - 150) - 50;
    return std::max(ring, p.x() - 90);
  });
  reinitialise(phi);
  const geo::Region before = inside_of(phi);
  for (int k = 0; k < 50; ++k) reinitialise(phi);
  // 1.7 km of boundary around 9 ha: a tenth of a cell all around would be 2 %, and most
  // of what goes are the sharp corners.
  EXPECT_GT(geo::iou(before, inside_of(phi)), 0.98);
}

TEST(Reinitialise, MirrorsWithTheSign) {
  const auto shape = [](const Vec2& p) { return (p.norm() - 100) * 2; };
  Field phi = field_of(200, 10, shape);
  Field negative = field_of(200, 10, [&](const Vec2& p) { return -shape(p); });
  reinitialise(phi);
  reinitialise(negative);
  // Only the order of the operations differs: rounding of floats.
  for (std::size_t i = 0; i < phi.values.size(); ++i)
    EXPECT_NEAR(static_cast<double>(phi.values[i]),
                -static_cast<double>(negative.values[i]), 1e-3);
}

TEST(Reinitialise, AFieldWithoutContourIsLeftAlone) {
  Field phi = field_of(50, 10, [](const Vec2& p) { return 7 + 0.01 * p.x(); });
  const Field before = phi;
  reinitialise(phi);
  EXPECT_EQ(phi.values, before.values);
}

TEST(Reinitialise, SaddleAndExactZerosStayFinite) {
  Field phi = field_of(50, 10, [](const Vec2& p) { return p.x() * p.y() / 50; });
  reinitialise(phi);
  for (const float v : phi.values) {
    EXPECT_TRUE(std::isfinite(v));
    EXPECT_LT(std::abs(v), 51.0F);
  }
}

}  // namespace
}  // namespace skein::model::reinitialise_test
