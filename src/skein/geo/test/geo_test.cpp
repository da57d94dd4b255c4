// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "skein/base/random.h"
#include "skein/geo/boundary_index.h"
#include "skein/geo/clip.h"
#include "skein/geo/local_frame.h"
#include "skein/geo/self_crossing.h"
#include "skein/geo/vec.h"

namespace skein::geo::geo_test {
namespace {

Ring circle(const Vec2& centre, double radius, int count) {
  Ring ring;
  for (int i = 0; i < count; ++i)
    ring.push_back(centre + radius * unit(2 * kPi * i / count));
  return ring;
}

// Products of large matrices are split, and so summed, by these.
TEST(Eigen, CountsOnTheSameCachesOnEveryProcessor) {
  EXPECT_EQ(Eigen::l1CacheSize(), 32 * 1024);
  EXPECT_EQ(Eigen::l2CacheSize(), 256 * 1024);
  EXPECT_EQ(Eigen::l3CacheSize(), 2 * 1024 * 1024);
}

TEST(Angles, WrapIntoTheirRanges) {
  EXPECT_DOUBLE_EQ(wrap_pi(3 * kPi), kPi);
  EXPECT_DOUBLE_EQ(wrap_pi(-kPi), kPi);
  EXPECT_DOUBLE_EQ(wrap_2pi(-kPi / 2), 1.5 * kPi);
  EXPECT_LT(wrap_2pi(-1e-20), 2 * kPi);
  for (double b : {-3.0, -0.5, 0.0, 2.0}) EXPECT_NEAR(bearing(unit(b)), b, 1e-15);
  EXPECT_NEAR((turned_right(unit(0.3)) - unit(0.3 + kPi / 2)).norm(), 0, 1e-15);
}

TEST(SelfCrossing, IsFoundWithItsPlaceAndNotWhereEdgesOnlyTouch) {
  EXPECT_FALSE(self_crossing(circle({3, 4}, 50, 40)));
  // A bow tie: its diagonals cross in the middle.
  const auto at = self_crossing(Ring{{0, 0}, {10, 10}, {10, 0}, {0, 10}});
  ASSERT_TRUE(at);
  EXPECT_EQ(at->first, 0u);
  EXPECT_EQ(at->second, 2u);
  EXPECT_NEAR((at->point - Vec2(5, 5)).norm(), 0, 1e-12);
  // Two triangles that meet in one corner.
  EXPECT_FALSE(self_crossing(Ring{{0, 0}, {5, 5}, {10, 0}, {10, 10}, {5, 5}, {0, 10}}));
  // The last edge counts.
  const auto last = self_crossing(Ring{{0, 0}, {0, 10}, {10, 10}, {-5, 5}, {8, 2}});
  ASSERT_TRUE(last);
  EXPECT_FALSE(self_crossing(Ring{{0, 0}, {1, 1}}));
}

TEST(LocalFrame, GoesThereAndBack) {
  const LocalFrame frame = LocalFrame::at({38.9, -121.05, 300}).value();
  const Vec3 p(1234, -5678, -90);
  EXPECT_LT((frame.to_local(frame.to_geodetic(p)) - p).norm(), 1e-7);
  const Vec2 q(25000, 31000);
  const Geodetic g = frame.from_plane(q);
  EXPECT_LT((frame.to_plane(g.latitude_deg, g.longitude_deg) - q).norm(), 1e-4);
}

TEST(LocalFrame, OneDegreeOfLatitudeAtTheEquator) {
  // Meridian arc of 0.01 deg at the equator: 1105.743 m (WGS 84: a(1-e^2) pi/180/100).
  const LocalFrame frame = LocalFrame::at({0, 0, 0}).value();
  EXPECT_NEAR(frame.to_plane(0.01, 0).x(), 1105.743, 0.001);
  EXPECT_NEAR(frame.to_plane(0, 0.01).y(), 1113.195, 0.001);
}

TEST(LocalFrame, RefusesAnImpossibleOrigin) {
  EXPECT_FALSE(LocalFrame::at({91, 0, 0}).ok());
  EXPECT_FALSE(LocalFrame::at({0, std::numeric_limits<double>::quiet_NaN(), 0}).ok());
}

TEST(Polygon, AreaIsPositiveClockwiseOnTheMap) {
  const Ring north_then_east = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  EXPECT_DOUBLE_EQ(signed_area(north_then_east), 100);
  const Vec2 normal = outward_normal(north_then_east[1] - north_then_east[0]);
  EXPECT_LT((normal - Vec2(0, -1)).norm(), 1e-15);
  EXPECT_TRUE(contains(north_then_east, Vec2(5, 5)));
  EXPECT_FALSE(contains(north_then_east, Vec2(11, 5)));
  EXPECT_DOUBLE_EQ(length(north_then_east), 40);
}

TEST(Polygon, ResampleKeepsEqualArcLength) {
  const Ring square = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const Ring points = resample(square, 8);
  ASSERT_EQ(points.size(), 8u);
  EXPECT_LT((points[1] - Vec2(5, 0)).norm(), 1e-12);
  EXPECT_LT((points[7] - Vec2(0, 5)).norm(), 1e-12);
  EXPECT_EQ(resample_by_spacing(square, 4).size(), 10u);
}

TEST(BoundaryIndex, AgreesWithBruteForce) {
  RandomStream random(3, 0, Purpose::kTest);
  Region region = {circle({0, 0}, 500, 300), circle({900, 200}, 100, 17)};
  Ring hole = circle({100, 50}, 120, 40);
  std::reverse(hole.begin(), hole.end());
  region.push_back(hole);
  for (Vec2& p : region[0]) p += Vec2(random.normal(), random.normal()) * 3;
  const BoundaryIndex index(region);
  for (int k = 0; k < 3000; ++k) {
    const Vec2 p(random.uniform(-3000, 3000), random.uniform(-3000, 3000));
    const Vec2 q = k % 2 ? p : p / 4;
    double best = std::numeric_limits<double>::infinity();
    for (const Ring& ring : region)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i], ab = ring[(i + 1) % ring.size()] - a;
        const double t = std::clamp((q - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
        best = std::min(best, (q - a - t * ab).norm());
      }
    EXPECT_NEAR(index.nearest(q).distance, best, 1e-9) << q.transpose();
    EXPECT_EQ(index.contains(q), contains(region, q)) << q.transpose();
  }
}

TEST(BoundaryIndex, FindsTheSameEdgesForAnyNumberOfThem) {
  // Leaves that are full, partly full and empty.
  for (int n = 1; n <= 40; ++n) {
    const Ring ring = circle({0, 0}, 100, n);
    const BoundaryIndex index({ring});
    for (int i = 0; i < n; ++i) {
      const Vec2 middle = (ring[static_cast<std::size_t>(i)] +
                           ring[static_cast<std::size_t>((i + 1) % n)]) /
                          2;
      const NearestPoint found = index.nearest(middle);
      EXPECT_NEAR(found.distance, 0, 1e-9) << n << " " << i;
      if (n > 2) {
        EXPECT_EQ(found.edge, i) << n;
        EXPECT_NEAR(found.along, 0.5, 1e-9);
      }
    }
  }
}

TEST(BoundaryIndex, WorksFarAwayAndForDegenerateRings) {
  const BoundaryIndex line({{{0, 0}, {0, 100}}});
  EXPECT_NEAR(line.nearest({3e4, 50}).distance, 3e4, 1e-6);
  const BoundaryIndex point({{{5, 5}}});
  EXPECT_NEAR(point.nearest({5, 105}).distance, 100, 1e-9);
  const BoundaryIndex none({});
  EXPECT_TRUE(none.empty());
  EXPECT_FALSE(none.contains({0, 0}));
}

TEST(Clip, CleansASelfCrossingRing) {
  const Region eight = {{{0, 0}, {10, 10}, {10, 0}, {0, 10}}};
  EXPECT_NEAR(area(clean(eight, FillRule::kEvenOdd)), 50, 1e-3);
  EXPECT_NEAR(area(clean(eight, FillRule::kPositive)), 25, 1e-3);
}

TEST(Clip, TouchingRingsKeepTheirArea) {
  // Two squares that meet in a corner, and one that the first overlaps.
  const Region squares = {{{0, 0}, {10, 0}, {10, 10}, {0, 10}},
                          {{10, 10}, {20, 10}, {20, 20}, {10, 20}},
                          {{5, 5}, {8, 5}, {8, 8}, {5, 8}}};
  EXPECT_NEAR(area(clean_touching(squares, FillRule::kPositive)), 200, 1e-3);
  EXPECT_NEAR(area(clean(squares, FillRule::kPositive)), 200, 1e-3);
}

TEST(Clip, AreasAddUp) {
  const Region a = {circle({0, 0}, 100, 90)}, b = {circle({60, 30}, 80, 70)};
  const double both = area(intersect(a, b));
  EXPECT_NEAR(area(unite(a, b)) + both, area(a) + area(b), 0.1);
  EXPECT_NEAR(area(subtract(a, b)) + both, area(a), 0.1);
  EXPECT_NEAR(iou(a, a), 1, 1e-9);
  EXPECT_EQ(iou(a, {circle({1000, 0}, 10, 9)}), 0);
}

TEST(Clip, KeepsHolesNegative) {
  const Region ring = subtract({circle({0, 0}, 100, 90)}, {circle({0, 0}, 50, 90)});
  ASSERT_EQ(ring.size(), 2u);
  EXPECT_GT(signed_area(ring[0]) * -signed_area(ring[1]), 0);
  EXPECT_FALSE(contains(ring, Vec2(0, 0)));
  EXPECT_TRUE(contains(ring, Vec2(75, 0)));
}

TEST(Clip, GrownRegionsKeepTheDistanceAndLittleMore) {
  const Region shape = {{{0, 0}, {100, 0}, {100, 100}, {50, 20}, {0, 100}}};
  const BoundaryIndex border(shape);
  for (const double distance : {5.0, 30.0, 80.0}) {
    const Region wider = grown(shape, distance, 0.5);
    const BoundaryIndex wide(wider);
    for (const Ring& ring : wider)
      for (const Vec2& p : resample_by_spacing(ring, 2)) {
        ASSERT_GE(border.signed_distance(p), distance - 1e-3);
        ASSERT_LE(border.signed_distance(p), distance + 1 + 1e-3);
      }
    for (double angle = 0; angle < 6; angle += 0.1)
      ASSERT_TRUE(wide.contains(Vec2(100, 100) + (distance - 1e-3) * unit(angle)));
  }
  // What overlaps becomes one, in the opposite sense as well.
  const Region two = {{{0, 0}, {10, 0}, {10, 10}}, {{30, 0}, {20, 10}, {30, 10}}};
  EXPECT_EQ(grown(two, 3, 0.5).size(), 2u);
  EXPECT_EQ(grown(two, 30, 0.5).size(), 1u);
}

}  // namespace
}  // namespace skein::geo::geo_test
