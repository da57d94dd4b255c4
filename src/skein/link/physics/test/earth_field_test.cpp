// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/earth_field.h"

#include <gtest/gtest.h>

#include "skein/base/math.h"
#include "skein/geo/rotation.h"

namespace skein::physics::earth_field_test {
namespace {

// What maps of the field show, as far as a dipole goes.
TEST(EarthField, PointsNorthAndDownInTheNorth) {
  const Vec3 prague = earth_field(50, 14.4), canberra = earth_field(-35.4, 149);
  EXPECT_NEAR(prague.norm(), 0.49, 0.03);
  EXPECT_GT(prague.x(), 0.15);
  EXPECT_GT(prague.z(), 0.4);
  EXPECT_GT(canberra.x(), 0.15);
  EXPECT_LT(canberra.z(), -0.35);
  EXPECT_NEAR(earth_field(90, 0).z(), 0.587, 0.001);  // twice the axial coefficient
}

TEST(EarthField, TakesADeclination) {
  const Vec3 own = earth_field(37, -122);
  const Vec3 given = earth_field(37, -122, geo::radians(13));
  EXPECT_NEAR(geo::degrees(math::atan2(given.y(), given.x())), 13, 1e-9);
  EXPECT_NEAR(given.norm(), own.norm(), 1e-12);
  EXPECT_EQ(given.z(), own.z());
}

}  // namespace
}  // namespace skein::physics::earth_field_test
