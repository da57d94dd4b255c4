// SPDX-License-Identifier: Apache-2.0
#include "skein/model/levelset/field.h"

#include <gtest/gtest.h>

#include "shapes.h"
#include "skein/base/check.h"

namespace skein::model::field_test {
namespace {

double plane(const Vec2& p) {
  return 3 + 0.5 * p.x() - 0.25 * p.y();
}

TEST(Field, SamplesAndDifferentiatesAPlaneExactly) {
  const Field field = field_of(50, 10, plane);
  // Values are floats of size 30: a few 1e-6 of rounding.
  for (const Vec2& p : {Vec2(0, 0), Vec2(-13.5, 22.1), Vec2(39, -31), Vec2(50, 50)}) {
    EXPECT_NEAR(sample(field, p), plane(p), 1e-5);
    EXPECT_NEAR((gradient(field, p) - Vec2(0.5, -0.25)).norm(), 0, 1e-5);
  }
}

TEST(Field, PointsOutsideTakeTheNearestValueOfTheGrid) {
  const Field field = field_of(50, 10, plane);
  EXPECT_NEAR(sample(field, {80, 12}), plane({50, 12}), 1e-5);
  EXPECT_NEAR(sample(field, {-900, 900}), plane({-50, 50}), 1e-5);
}

TEST(Field, ExtensionKeepsOldNodesAndIsADistanceBoundBeyond) {
  const auto circle = [](const Vec2& p) { return p.norm() - 30; };
  const Field field = field_of(50, 10, circle);
  const Field wide = extended(field, 2, 0, 1, 3);
  EXPECT_EQ(wide.grid.rows, field.grid.rows + 3);
  EXPECT_EQ(wide.grid.columns, field.grid.columns + 3);
  for (int r = 0; r < wide.grid.rows; ++r)
    for (int c = 0; c < wide.grid.columns; ++c) {
      const Vec2 p = wide.grid.node(r, c);
      if (p.cwiseAbs().maxCoeff() <= 50) {
        EXPECT_NEAR(static_cast<double>(wide.at(r, c)), circle(p), 1e-4);
      } else {
        // A path to the circle along the grid's edge is never shorter.
        EXPECT_GE(static_cast<double>(wide.at(r, c)), circle(p) - 1e-4);
      }
    }
}

TEST(Field, CoarseningKeepsEverySecondNode) {
  const Field field = field_of(40, 10, plane);
  const Field coarse = coarsened(field);
  EXPECT_EQ(coarse.grid.rows, 5);
  EXPECT_EQ(coarse.grid.cell, 20);
  for (int r = 0; r < 5; ++r)
    for (int c = 0; c < 5; ++c) EXPECT_EQ(coarse.at(r, c), field.at(2 * r, 2 * c));
  EXPECT_THROW(coarsened(extended(field, 1, 0, 0, 0)), Bug);
}

}  // namespace
}  // namespace skein::model::field_test
