// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/path_cursor.h"

#include <gtest/gtest.h>

#include "skein/base/check.h"
#include "skein/base/random.h"
#include "skein/model/path/path_geometry.h"

namespace skein::model::path_cursor_test {
namespace {

Path random_path(RandomStream& random) {
  Path path;
  Pose at{{0, 0}, random.uniform(-3, 3)};
  for (int i = 0; i < 8; ++i) {
    const double curvature = i % 2 == 0 ? 0 : random.uniform(-0.05, 0.05);
    path.push_back({at.position, at.course, random.uniform(0.5, 150), curvature});
    at = end_of(path.back());
  }
  return path;
}

TEST(PathCursor, AgreesWithTheSearchOfAllElements) {
  RandomStream random(5, 0, Purpose::kTest);
  for (int n = 0; n < 200; ++n) {
    const Path path = random_path(random);
    PathCursor cursor;
    cursor.assign(path);
    EXPECT_DOUBLE_EQ(cursor.length(), length(path));
    for (int k = 0; k < 50; ++k) {
      const Vec2 p(random.uniform(-400, 400), random.uniform(-400, 400));
      const double from = random.uniform(-50, cursor.length());
      const double to = from + random.uniform(0, 300);
      const PathProjection slow = project(path, p, from, to);
      const PathCursor::Place fast = cursor.project(p, from, to);
      // Two points equally near up to rounding may be ordered differently.
      const double gap = (p - pose_at(path, slow.along).position).norm() -
                         (p - fast.point.position).norm();
      EXPECT_NEAR(gap, 0, 1e-9);
      if (std::abs(slow.along - fast.along) > 1e-6) continue;
      EXPECT_NEAR(fast.cross_track, slow.cross_track, 1e-6);
      EXPECT_NEAR(fast.remaining, slow.remaining, 1e-6);
      EXPECT_NEAR(geo::wrap_pi(fast.course - slow.course), 0, 1e-8);
      EXPECT_NEAR(geo::wrap_pi(geo::bearing(fast.point.tangent) - slow.course), 0, 1e-8);
    }
  }
}

TEST(PathCursor, FollowsAPathThatCrossesItself) {
  // A loop of one turn and a half: the crossing is passed twice.
  const Path path = {{{0, 0}, 0, 3 * geo::kPi * 50, 1.0 / 50}};
  PathCursor cursor;
  cursor.assign(path);
  double along = 0;
  for (double s = 0; s < path[0].length; s += 1) {
    const Vec2 p = pose_at(path[0], s).position;
    along = cursor.project(p, along - 20, along + 20).along;
    EXPECT_NEAR(along, s, 1e-9);
  }
}

TEST(PathCursor, GivesPointsAndCurvaturesAlongThePath) {
  RandomStream random(6, 0, Purpose::kTest);
  const Path path = random_path(random);
  PathCursor cursor;
  cursor.assign(path);
  for (double s = -30; s < cursor.length() + 30; s += 3.7) {
    const Pose pose = pose_at(path, s);
    const TrackPoint at = cursor.at(s);
    EXPECT_LT((at.position - pose.position).norm(), 1e-9);
    EXPECT_LT((at.tangent - geo::unit(pose.course)).norm(), 1e-9);
    EXPECT_EQ(cursor.curvature_at(s), curvature_at(path, s));
    EXPECT_EQ(at.curvature, curvature_at(path, s));
  }
}

TEST(PathCursor, KnowsTheTightestTurnAndTheSpeedBeforeIt) {
  PathCursor cursor;
  cursor.assign({{{0, 0}, 0, 100, 0},
                 {{100, 0}, 0, 20, 0.02},
                 {{119, 4}, 0.4, 50, 0},
                 {{160, 20}, 0.4, 20, -0.1}});
  EXPECT_EQ(cursor.tightest(0, 99), 0);
  EXPECT_EQ(cursor.tightest(0, 101), 0.02);
  EXPECT_EQ(cursor.tightest(121, 200), 0.1);
  // 2 m/s^2 across and 1 m/s^2 to brake: 10 m/s in the first turn, sqrt(20) in the
  // second, which holds at the first's end: sqrt(20 + 2 50).
  EXPECT_NEAR(cursor.speed_limit(110, 2, 1, 30), 10, 1e-12);
  EXPECT_NEAR(cursor.speed_limit(175, 2, 1, 30), std::sqrt(20), 1e-12);
  EXPECT_NEAR(cursor.speed_limit(160, 2, 1, 30), std::sqrt(20 + 2 * 10), 1e-12);
  EXPECT_NEAR(cursor.speed_limit(50, 2, 1, 30), std::sqrt(100 + 2 * 50), 1e-12);
  EXPECT_NEAR(cursor.speed_limit(50, 2, 1, 12), 12, 1e-12);
}

TEST(PathCursor, EmptyPathsAreABug) {
  PathCursor cursor;
  EXPECT_TRUE(cursor.empty());
  EXPECT_EQ(cursor.tightest(0, 10), 0);
  EXPECT_THROW(cursor.project({0, 0}, 0, 1), Bug);
  EXPECT_THROW(cursor.at(0), Bug);
}

}  // namespace
}  // namespace skein::model::path_cursor_test
