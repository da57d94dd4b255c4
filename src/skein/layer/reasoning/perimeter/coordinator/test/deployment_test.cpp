// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/coordinator/deployment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "skein/base/random.h"

namespace skein::perimeter::deployment_test {
namespace {

// A circle whose radius is known to `sigma`.
BoundaryEstimate circle(const Vec2& centre, double radius, double sigma) {
  BoundaryEstimate boundary;
  auto& ring = boundary.rings.emplace_back();
  for (int k = 0; k < 60; ++k) {
    BoundaryPoint point;
    point.normal = geo::unit(k * geo::kPi / 30);
    point.position = centre + radius * point.normal;
    point.sigma = sigma;
    ring.push_back(point);
  }
  return boundary;
}

// Largest angle between neighbouring entries, from the origin.
double widest_gap(const std::vector<Entry>& entries) {
  std::vector<double> courses;
  for (const Entry& entry : entries) courses.push_back(geo::wrap_2pi(entry.course));
  std::sort(courses.begin(), courses.end());
  double widest = courses.front() + 2 * geo::kPi - courses.back();
  for (std::size_t k = 1; k < courses.size(); ++k)
    widest = std::max(widest, courses[k] - courses[k - 1]);
  return widest;
}

TEST(Deployment, EntriesLieOutsideOnAllSidesWhereverAircraftComeFrom) {
  RandomStream random(3, 0, Purpose::kTest);
  const Vec2 origin(200, -100);
  const BoundaryEstimate fire = circle(origin, 300, 40);
  for (int round = 0; round < 50; ++round) {
    std::vector<Vec2> aircraft;
    const int n = 1 + round % 6;
    for (int k = 0; k < n; ++k)
      aircraft.push_back({random.uniform(-3000, 3000), random.uniform(-3000, 3000)});
    const auto entries = plan_entries(fire, origin, aircraft);
    ASSERT_EQ(entries.size(), aircraft.size());
    EXPECT_NEAR(widest_gap(entries), 2 * geo::kPi / n, 1e-9);
    for (const Entry& entry : entries) {
      EXPECT_GT((entry.place - origin).norm(), 300 + 2 * 40);
      // Its transect leads to the origin.
      const Vec2 to = origin - entry.place;
      EXPECT_GT(to.normalized().dot(geo::unit(entry.course)), 1 - 1e-9);
    }
  }
}

TEST(Deployment, TheLastIsThereAsEarlyAsCanBe) {
  const BoundaryEstimate fire = circle({0, 0}, 300, 0);
  // Against all assignments of four aircraft at some sides.
  RandomStream random(4, 0, Purpose::kTest);
  for (int round = 0; round < 20; ++round) {
    std::vector<Vec2> aircraft;
    for (int k = 0; k < 4; ++k)
      aircraft.push_back({random.uniform(-2000, 2000), random.uniform(-2000, 2000)});
    double planned = 0;
    const auto entries = plan_entries(fire, {0, 0}, aircraft);
    for (std::size_t k = 0; k < 4; ++k)
      planned = std::max(planned, (entries[k].place - aircraft[k]).norm());
    double least = 1e9;
    for (int offset = 0; offset < 24; ++offset) {
      std::vector<int> sides = {0, 1, 2, 3};
      do {
        double longest = 0;
        for (std::size_t k = 0; k < 4; ++k)
          longest = std::max(
              longest,
              (450 * geo::unit((sides[k] + offset / 24.0) * geo::kPi / 2) - aircraft[k])
                  .norm());
        least = std::min(least, longest);
      } while (std::next_permutation(sides.begin(), sides.end()));
    }
    EXPECT_NEAR(planned, least, 1e-6 * least) << round;
  }
}

TEST(Deployment, EntriesFollowTheShapeOfTheBoundary) {
  // Twice as far out to the north.
  BoundaryEstimate fire = circle({0, 0}, 300, 0);
  for (BoundaryPoint& point : fire.rings.front())
    if (point.position.x() > 0) point.position.x() *= 2;
  const std::vector<Vec2> aircraft = {{3000, 0}, {-3000, 0}};
  const auto entries = plan_entries(fire, {0, 0}, aircraft);
  EXPECT_NEAR(entries[0].place.x(), 600 + 150, 1);
  EXPECT_NEAR(entries[1].place.x(), -300 - 150, 1);
}

}  // namespace
}  // namespace skein::perimeter::deployment_test
