// SPDX-License-Identifier: Apache-2.0
#include "skein/model/levelset/advance.h"

#include <gtest/gtest.h>

#include "shapes.h"
#include "skein/geo/clip.h"
#include "skein/model/levelset/reinitialise.h"

namespace skein::model::advance_test {
namespace {

// A circle of radius 80 that grows for 60 s at 2 m/s, redistanced every 10 s.
double grown_circle_error(double cell) {
  Field phi = field_of(300, cell, [](const Vec2& p) { return p.norm() - 80; });
  const std::vector<float> speed(phi.values.size(), 2.0F);
  for (int k = 0; k < 6; ++k) {
    advance(phi, {speed, Vec2::Zero()}, 10, 1e9);
    if (k % 2 == 1) reinitialise(phi);
  }
  return circle_error(phi, 200);
}

TEST(Advance, CircleAtConstantRateKeepsTheAnalyticRadius) {
  const double coarse = grown_circle_error(20), fine = grown_circle_error(10),
               finest = grown_circle_error(5);
  // From a radius of four cells over six cells of travel: within a tenth of a cell, and
  // falling at least linearly.
  EXPECT_LT(coarse, 2.0);
  EXPECT_LT(fine, 0.5 * coarse);
  EXPECT_LT(finest, 0.5 * fine);
}

TEST(Advance, ANarrowBandGivesTheSameFront) {
  Field wide = field_of(300, 10, [](const Vec2& p) { return p.norm() - 80; });
  Field narrow = wide;
  const std::vector<float> speed(wide.values.size(), 2.0F);
  for (int k = 0; k < 12; ++k) {
    advance(wide, {speed, Vec2::Zero()}, 10, 1e9);
    advance(narrow, {speed, Vec2::Zero()}, 10, 60);
    reinitialise(wide);
    reinitialise(narrow);
  }
  // The band's rim is reached by the stencil only after redistancing has mended it.
  EXPECT_LT(std::abs(circle_error(wide, 320) - circle_error(narrow, 320)), 0.05);
}

TEST(Advance, DriftMovesACircleDownwindAndNeverShrinksIt) {
  Field phi = field_of(300, 10, [](const Vec2& p) { return p.norm() - 80; });
  const geo::Region before = inside_of(phi);
  const std::vector<float> speed(phi.values.size(), 0.0F);
  advance(phi, {speed, Vec2(1, 0)}, 60, 1e9);
  const geo::Region after = inside_of(phi);
  double front = -1e9, back = 1e9;
  for (const Vec2& p : after.at(0)) {
    front = std::max(front, p.x());
    back = std::min(back, p.x());
  }
  // The head moves 60 m; the rear, where the drift points inwards, stays (half a cell for
  // the rounding of the corner that forms).
  EXPECT_NEAR(front, 140, 2);
  EXPECT_NEAR(back, -80, 2);
  EXPECT_LT(geo::area(geo::subtract(before, after)), 1e-3 * geo::area(before));
}

TEST(Advance, TwoFrontsMergeIntoOne) {
  Field phi = field_of(300, 10, [](const Vec2& p) {
    return std::min((p - Vec2(0, -100)).norm(), (p - Vec2(0, 100)).norm()) - 60;
  });
  EXPECT_EQ(inside_of(phi).size(), 2U);
  const std::vector<float> speed(phi.values.size(), 1.0F);
  advance(phi, {speed, Vec2::Zero()}, 60, 1e9);
  EXPECT_EQ(inside_of(phi).size(), 1U);
}

TEST(Advance, WithoutSpeedOrTimeNothingMoves) {
  Field phi = field_of(100, 10, [](const Vec2& p) { return p.norm() - 50; });
  const Field before = phi;
  const std::vector<float> still(phi.values.size(), -1.0F),
      moving(phi.values.size(), 1.0F);
  advance(phi, {still, Vec2::Zero()}, 60, 1e9);
  EXPECT_EQ(phi.values, before.values);
  advance(phi, {moving, Vec2::Zero()}, 0, 1e9);
  EXPECT_EQ(phi.values, before.values);
}

}  // namespace
}  // namespace skein::model::advance_test
