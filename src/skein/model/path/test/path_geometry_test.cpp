// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/path_geometry.h"

#include <gtest/gtest.h>

#include <limits>

#include "skein/base/random.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::model::path_geometry_test {
namespace {

Path sample_path() {
  Path path{{{0, 0}, 0.3, 200, 0}};
  for (const double curvature : {0.01, -0.005, 0.0}) {
    const Pose end = end_of(path.back());
    path.push_back({end.position, end.course, 150, curvature});
  }
  return path;
}

TEST(PathGeometry, PoseAgreesWithIntegration) {
  const Path path = sample_path();
  Pose pose{{0, 0}, 0.3};
  const double step = 0.01;
  for (int i = 0; i < 65000; ++i) {
    const double s = i * step;
    if (i % 1000 == 0) {
      // Midpoint rule: error k^2 step^2 s / 24 < 1e-6 m, and a step's worth of curvature
      // error where elements join.
      EXPECT_LT((pose_at(path, s).position - pose.position).norm(), 1e-3);
      EXPECT_NEAR(geo::wrap_pi(pose_at(path, s).course - pose.course), 0, 3e-4);
    }
    const double turn = curvature_at(path, s + step / 2) * step;
    pose.position += step * geo::unit(pose.course + turn / 2);
    pose.course += turn;
  }
  EXPECT_DOUBLE_EQ(length(path), 650);
}

TEST(PathGeometry, GoesOnStraightBeyondItsEnds) {
  const Path path = sample_path();
  const Pose end = end_of(path.back());
  EXPECT_LT(
      (pose_at(path, 660).position - end.position - 10 * geo::unit(end.course)).norm(),
      1e-9);
  EXPECT_LT((pose_at(path, -10).position + 10 * geo::unit(0.3)).norm(), 1e-9);
}

TEST(PathGeometry, ProjectionAgreesWithSearch) {
  const Path path = sample_path();
  RandomStream random(1, 0, Purpose::kTest);
  for (int i = 0; i < 300; ++i) {
    const Vec2 p{random.uniform(-200, 600), random.uniform(-200, 400)};
    const double from = random.uniform(0, 300), to = from + random.uniform(0, 350);
    double best = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 5000; ++k) {
      const double s = from + (to - from) * k / 5000;
      best = std::min(best, (pose_at(path, s).position - p).norm());
    }
    const PathProjection found = project(path, p, from, to);
    EXPECT_GE(found.along, from - 1e-9);
    EXPECT_LE(found.along, to + 1e-9);
    const double distance = (pose_at(path, found.along).position - p).norm();
    EXPECT_LE(distance, best + 1e-9);
    EXPECT_NEAR(distance, best, 0.1);  // the search steps 0.07 m
    EXPECT_NEAR(found.remaining, 650 - found.along, 1e-9);
  }
}

TEST(PathGeometry, CrossTrackIsRightPositive) {
  const Path north{{{0, 0}, 0, 100, 0}};
  EXPECT_NEAR(project(north, {50, 7}, 0, 100).cross_track, 7, 1e-12);
  EXPECT_NEAR(project(north, {50, -7}, 0, 100).cross_track, -7, 1e-12);
  const Path circle{{{0, 0}, 0, 2 * geo::kPi * 100, 0.01}};  // centre 100 m east
  EXPECT_NEAR(project(circle, {0, 10}, 0, 700).cross_track, 10, 1e-9);
  EXPECT_NEAR(project(circle, {0, 210}, 100, 500).cross_track, -10, 1e-9);
}

TEST(PathGeometry, TwoTurnsAreDistinguishedByTheBounds) {
  const double turn = 2 * geo::kPi * 100;
  const Path circle{{{0, 0}, 0, 2 * turn, 0.01}};
  const Vec2 p = pose_at(circle, 150).position;
  EXPECT_NEAR(project(circle, p, 0, 2 * turn).along, 150, 1e-6);
  EXPECT_NEAR(project(circle, p, turn, 2 * turn).along, turn + 150, 1e-6);
}

TEST(WindTriangle, HeadingMakesGoodTheCourse) {
  RandomStream random(2, 0, Purpose::kTest);
  for (int i = 0; i < 1000; ++i) {
    const double course = random.uniform(-geo::kPi, geo::kPi);
    const Vec2 wind =
        random.uniform(0, 19.9) * geo::unit(random.uniform(0, 2 * geo::kPi));
    const auto heading = heading_for_course(course, 20, wind);
    ASSERT_TRUE(heading);
    const Vec2 v = 20 * geo::unit(*heading) + wind;
    EXPECT_NEAR(geo::wrap_pi(geo::bearing(v) - course), 0, 1e-9);
  }
}

TEST(WindTriangle, SaysWhenTheWindIsTooStrong) {
  EXPECT_FALSE(heading_for_course(0, 20, {-21, 0}));
  EXPECT_FALSE(heading_for_course(0, 20, {0, 20}));
  EXPECT_TRUE(heading_for_course(0, 20, {25, 0}));
}

TEST(WindTriangle, GroundRadiusIsFlyableAtEveryHeading) {
  const double airspeed = 20, radius = 60, wind = 8;
  const double ground = ground_turn_radius(radius, airspeed, wind);
  double largest = 0;
  for (int i = 0; i < 3600; ++i) {
    // Course rate that the circle asks for, as a turn rate of the heading.
    const double heading = 2 * geo::kPi * i / 3600;
    const Vec2 v = airspeed * geo::unit(heading) + Vec2(wind, 0);
    const double cosine = geo::unit(heading).dot(v) / v.norm();
    largest = std::max(largest, v.squaredNorm() / (ground * airspeed * cosine));
  }
  EXPECT_LE(largest, airspeed / radius * (1 + 1e-9));
  EXPECT_GE(largest, airspeed / radius * 0.999);
}

}  // namespace
}  // namespace skein::model::path_geometry_test
