// SPDX-License-Identifier: Apache-2.0
#include "skein/model/levelset/spline_field.h"

#include <gtest/gtest.h>

#include "shapes.h"
#include "skein/base/random.h"

namespace skein::model::spline_field_test {
namespace {

TEST(SplineField, ReproducesConstantsAndPlanes) {
  SplineField field{field_of(300, 60, [](const Vec2& p) { return 2 + 0.1 * p.x(); })};
  // Cubic B-splines reproduce polynomials to third degree (floats of size 30).
  for (const Vec2& p : {Vec2(0, 0), Vec2(17, -93), Vec2(-121.5, 200)})
    EXPECT_NEAR(field.sample(p), 2 + 0.1 * p.x(), 1e-4);
}

TEST(SplineField, AddsToAGridWhatItSamples) {
  RandomStream random(1, 0, Purpose::kTest);
  const SplineField field{
      field_of(180, 60, [&](const Vec2&) { return random.normal(); })};
  Field out = field_of(120, 10, [](const Vec2&) { return 1.0; });
  field.add_to(out, -2);
  for (int r = 0; r < out.grid.rows; ++r)
    for (int c = 0; c < out.grid.columns; ++c)
      EXPECT_NEAR(static_cast<double>(out.at(r, c)),
                  1 - 2 * field.sample(out.grid.node(r, c)), 1e-5);
}

TEST(SplineField, WhiteCoefficientsGiveTheStatedSpread) {
  RandomStream random(2, 0, Purpose::kTest);
  const SplineField field{
      field_of(6000, 60, [&](const Vec2&) { return random.normal(); })};
  double sum2 = 0;
  int count = 0;
  for (double x = -5800; x < 5800; x += 37)
    for (double y = -5800; y < 5800; y += 37) {
      const double v = field.sample(Vec2(x, y));
      sum2 += v * v;
      ++count;
    }
  // 40,000 coefficients, about 10,000 of them independent: 1 % of the spread, taken
  // threefold.
  EXPECT_NEAR(std::sqrt(sum2 / count), SplineField::kWhiteSd,
              0.03 * SplineField::kWhiteSd);
}

}  // namespace
}  // namespace skein::model::spline_field_test
