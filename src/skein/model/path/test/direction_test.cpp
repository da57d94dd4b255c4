// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/direction.h"

#include <gtest/gtest.h>

#include "skein/base/random.h"

namespace skein::model::direction_test {
namespace {

// As direction() promises, and half an ulp of the reference.
constexpr double kTolerance = 5e-16 + 3e-16;

TEST(Direction, IsTheAngleOfAnyPoint) {
  RandomStream random(31, 0, Purpose::kTest);
  for (int i = 0; i < 200'000; ++i) {
    const double size = math::exp(random.uniform(-40, 40));
    const double x = size * random.uniform(-1, 1), y = size * random.uniform(-1, 1);
    ASSERT_NEAR(direction(x, y), math::atan2(y, x), kTolerance) << x << ", " << y;
  }
}

TEST(Direction, IsRightOnAxesDiagonalsAndNextToThem) {
  for (const double x : {-1.0, -1e-300, -1e-9, 0.0, 1e-9, 1e-300, 1.0})
    for (const double y : {-1.0, -1e-9, 0.0, 1e-9, 1.0})
      EXPECT_NEAR(direction(x, y), math::atan2(y, x), kTolerance) << x << ", " << y;
  EXPECT_EQ(direction(-1, 0), geo::kPi);
  EXPECT_EQ(direction(-1, -0.0), -geo::kPi);
}

// Where one eighth hands over to the next.
TEST(Direction, IsContinuous) {
  for (int k = 0; k < 8; ++k) {
    const double t = (k + 0.5) / 8;
    for (const double step : {-1e-15, 0.0, 1e-15})
      EXPECT_NEAR(direction(1, t + step), math::atan2(t + step, 1), kTolerance) << k;
  }
}

TEST(NearestWhole, RoundsToTheNearest) {
  EXPECT_EQ(nearest_whole(0.49), 0);
  EXPECT_EQ(nearest_whole(-0.51), -1);
  EXPECT_EQ(nearest_whole(1e15), 1e15);
}

}  // namespace
}  // namespace skein::model::direction_test
