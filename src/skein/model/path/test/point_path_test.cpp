// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/point_path.h"

#include <gtest/gtest.h>

#include <limits>

#include "skein/base/random.h"
#include "skein/model/path/dubins.h"
#include "skein/model/path/path_geometry.h"

namespace skein::model::point_path_test {
namespace {

constexpr double kRadius = 60;

Pose random_pose(RandomStream& random) {
  return {{random.uniform(-50, 50), random.uniform(-50, 50)},
          random.uniform(-geo::kPi, geo::kPi)};
}

TEST(PointPath, EndsAtThePointWithTheStatedLength) {
  RandomStream random(1, 0, Purpose::kTest);
  for (int i = 0; i < 5000; ++i) {
    const double extent = i % 2 == 0 ? 90 : 400;
    const Pose from = random_pose(random);
    const Vec2 point{random.uniform(-extent, extent), random.uniform(-extent, extent)};
    const Path path = path_to_point(from, point, kRadius);
    ASSERT_FALSE(path.empty());
    EXPECT_LT((end_of(path.back()).position - point).norm(), 1e-9 * kRadius * 10);
    EXPECT_LT((path.front().start - from.position).norm(), 1e-12);
    EXPECT_NEAR(length(path), length_to_point(from, point, kRadius), 1e-9 * kRadius);
    for (const PathElement& e : path)
      EXPECT_LE(std::abs(e.curvature), 1 / kRadius + 1e-15);
  }
}

TEST(PointPath, IsTheBestOverAllEndCourses) {
  RandomStream random(2, 0, Purpose::kTest);
  for (int i = 0; i < 300; ++i) {
    const double extent = i % 3 == 0 ? 300 : 130;
    const Pose from = random_pose(random);
    const Vec2 point{random.uniform(-extent, extent), random.uniform(-extent, extent)};
    double best = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3600; ++k)
      best = std::min(best,
                      dubins(from, {point, 2 * geo::kPi * k / 3600}, kRadius).length());
    const double length = length_to_point(from, point, kRadius);
    EXPECT_LE(length, best + 1e-6);
    // The best end course is missed by up to 9e-4 rad, which costs at most two arcs of
    // order sqrt of that near circles that touch.
    EXPECT_NEAR(length, best, 0.07 * kRadius);
  }
}

TEST(PointPath, SimpleCases) {
  const Pose north{{0, 0}, 0};
  EXPECT_EQ(length_to_point(north, {0, 0}, kRadius), 0);
  EXPECT_TRUE(path_to_point(north, {0, 0}, kRadius).empty());
  EXPECT_NEAR(length_to_point(north, {100, 0}, kRadius), 100, 1e-9);
  EXPECT_NEAR(length_to_point(north, {60, 60}, kRadius), kRadius * geo::kPi / 2, 1e-9);
  EXPECT_NEAR(length_to_point(north, {0, 120}, kRadius), kRadius * geo::kPi, 1e-9);
  EXPECT_NEAR(length_to_point(north, {0, -120}, kRadius), kRadius * geo::kPi, 1e-9);
  // The centre of a turning circle: left pi/2 - beta, then right; both by the law of
  // cosines in the triangle 2, 2, 1.
  const double angle = std::acos(7.0 / 8);
  EXPECT_NEAR(length_to_point(north, {0, 60}, kRadius),
              kRadius * (angle + 2 * geo::kPi - std::acos(1.0 / 4)), 1e-6);
}

}  // namespace
}  // namespace skein::model::point_path_test
