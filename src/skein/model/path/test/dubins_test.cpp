// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/dubins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "skein/base/random.h"
#include "skein/model/path/path_geometry.h"

namespace skein::model::dubins_test {
namespace {

constexpr double kRadius = 60;

Pose random_pose(RandomStream& random, double extent) {
  return {{random.uniform(-extent, extent), random.uniform(-extent, extent)},
          random.uniform(-geo::kPi, geo::kPi)};
}

void expect_reaches(const DubinsPath& path, const Pose& from, const Pose& to) {
  const Path elements = to_path(path, from);
  Pose end = from;
  for (const PathElement& e : elements) {
    EXPECT_LT((e.start - end.position).norm(), 1e-9);
    EXPECT_LT(std::abs(geo::wrap_pi(e.course - end.course)), 1e-9);
    end = end_of(e);
  }
  // Angles are snapped to 1e-9 rad at most, which moves the end by 1e-9 of the radius.
  EXPECT_LT((end.position - to.position).norm(), 1e-9 * kRadius * 10);
  EXPECT_LT(std::abs(geo::wrap_pi(end.course - to.course)), 2e-9);
}

// Length of the best path turn(a), middle, turn(c) with these sides, found by trying
// first turns densely: an independent (slow) method that knows no closed form.
double searched_length(const Pose& from, const Pose& to, double r) {
  double best = std::numeric_limits<double>::infinity();
  for (const double s1 : {-1.0, 1.0}) {
    for (const double s3 : {-1.0, 1.0}) {
      const Vec2 c3 = to.position + s3 * r * geo::turned_right(geo::unit(to.course));
      for (int i = 0; i < 20000; ++i) {
        const double a = 2 * geo::kPi * i / 20000;
        const Pose p = pose_at(PathElement{from.position, from.course, 0, s1 / r}, a * r);
        // A straight from here must touch the last circle with the right sense.
        const Vec2 ahead = geo::unit(p.course);
        const double side = geo::cross(ahead, c3 - p.position) * s3;
        const double straight = (c3 - p.position).dot(ahead);
        if (std::abs(side - r) < 4e-4 * (straight + r) && straight > -0.02 * r) {
          const double c = geo::wrap_2pi(s3 * (to.course - p.course));
          best = std::min(best, a * r + std::max(0.0, straight) + c * r);
        }
        // An opposite turn from here must touch the last circle of the first's side.
        if (s1 != s3) continue;
        const Vec2 c2 = p.position - s1 * r * geo::turned_right(ahead);
        if (std::abs((c2 - c3).norm() - 2 * r) < 0.0005 * r) {
          const double contact = geo::bearing(c3 - c2) - s1 * geo::kPi / 2;
          const double b = geo::wrap_2pi(-s1 * (contact - p.course));
          const double c = geo::wrap_2pi(s1 * (to.course - contact));
          best = std::min(best, a * r + b * r + c * r);
        }
      }
    }
  }
  return best;
}

TEST(Dubins, EndsAtItsGoal) {
  RandomStream random(1, 0, Purpose::kTest);
  for (int i = 0; i < 2000; ++i) {
    const Pose from = random_pose(random, 200), to = random_pose(random, 200);
    expect_reaches(dubins(from, to, kRadius), from, to);
  }
}

TEST(Dubins, EveryWordIsShortestSomewhere) {
  RandomStream random(2, 0, Purpose::kTest);
  std::array<int, 6> best{};
  for (int i = 0; i < 5000; ++i) {
    const DubinsPath path =
        dubins(random_pose(random, 150), random_pose(random, 150), kRadius);
    ++best[static_cast<std::size_t>(path.word)];
  }
  for (const int count : best) EXPECT_GT(count, 50);
}

TEST(Dubins, AgreesWithSearch) {
  RandomStream random(3, 0, Purpose::kTest);
  for (int i = 0; i < 150; ++i) {
    const Pose from = random_pose(random, 130), to = random_pose(random, 130);
    const double length = dubins(from, to, kRadius).length();
    const double searched = searched_length(from, to, kRadius);
    // The search steps 3e-4 rad and accepts ends up to 1e-3 radii off; at grazing
    // tangents that moves a contact by sqrt(2 * 1e-3) = 0.045 rad.
    EXPECT_NEAR(length, searched, 0.1 * kRadius);
  }
}

TEST(Dubins, IsSymmetricUnderReversalAndMirror) {
  RandomStream random(4, 0, Purpose::kTest);
  for (int i = 0; i < 500; ++i) {
    const Pose from = random_pose(random, 200), to = random_pose(random, 200);
    const double length = dubins(from, to, kRadius).length();
    const Pose back_from{to.position, to.course + geo::kPi};
    const Pose back_to{from.position, from.course + geo::kPi};
    EXPECT_NEAR(dubins(back_from, back_to, kRadius).length(), length, 1e-8 * kRadius);
    const auto mirror = [](const Pose& p) {
      return Pose{{p.position.x(), -p.position.y()}, -p.course};
    };
    EXPECT_NEAR(dubins(mirror(from), mirror(to), kRadius).length(), length,
                1e-8 * kRadius);
  }
}

TEST(Dubins, GoalsOnTheOwnPathNeedNoLoop) {
  for (const double course : {0.0, 1.0, geo::kPi, -2.5}) {
    const Pose from{{10, -20}, course};
    EXPECT_EQ(dubins(from, from, kRadius).length(), 0);
    EXPECT_TRUE(to_path(dubins(from, from, kRadius), from).empty());
    for (const double curvature : {-1 / kRadius, 0.0, 1 / kRadius}) {
      const Pose ahead = pose_at(PathElement{from.position, course, 0, curvature}, 100);
      EXPECT_NEAR(dubins(from, ahead, kRadius).length(), 100, 1e-6);
    }
  }
}

TEST(Dubins, HalfTurnOnTheSpot) {
  // Same point, opposite course: RLR or LRL with angles pi/3, 5 pi/3, pi/3.
  const DubinsPath path = dubins({{0, 0}, 0}, {{0, 0}, geo::kPi}, kRadius);
  EXPECT_NEAR(path.length(), kRadius * 7 * geo::kPi / 3, 1e-9 * kRadius);
}

}  // namespace
}  // namespace skein::model::dubins_test
