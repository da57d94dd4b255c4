// SPDX-License-Identifier: Apache-2.0
#include "skein/geo/antimeridian.h"

#include <gtest/gtest.h>

#include <numeric>

#include "skein/base/random.h"
#include "skein/geo/clip.h"

namespace skein::geo::antimeridian_test {
namespace {

// 180 degrees are 532 m east of the origin.
const LocalFrame& near_180() {
  static const LocalFrame at = LocalFrame::at({-16.8, 179.995, 0}).value();
  return at;
}

const LocalFrame& elsewhere() {
  static const LocalFrame at = LocalFrame::at({47, 8, 0}).value();
  return at;
}

Ring square(double half, Vec2 centre = {0, 0}) {
  return {centre + Vec2(half, -half), centre + Vec2(half, half),
          centre + Vec2(-half, half), centre + Vec2(-half, -half)};
}

Ring plane_ring(const std::vector<Geodetic>& places, const LocalFrame& frame) {
  Ring ring;
  for (const Geodetic& at : places)
    ring.push_back(frame.to_plane(at.latitude_deg, at.longitude_deg));
  return ring;
}

// Nothing steps over 180 degrees, and the parts make up the region again.
void expect_same(const Region& region, const LocalFrame& frame, std::size_t parts) {
  const std::vector<PlacePolygon> polygons = cut_region(region, frame);
  EXPECT_EQ(polygons.size(), parts);
  Region whole;
  double total = 0;
  for (const PlacePolygon& polygon : polygons) {
    Region part;
    for (const std::vector<Geodetic>& ring : polygon) {
      for (std::size_t k = 0; k < ring.size(); ++k)
        EXPECT_LT(
            std::abs(ring[k].longitude_deg - ring[(k + 1) % ring.size()].longitude_deg),
            180);
      part.push_back(plane_ring(ring, frame));
    }
    EXPECT_GT(signed_area(part.front()), 0) << "the outer ring comes first";
    for (std::size_t k = 1; k < part.size(); ++k) {
      EXPECT_LT(signed_area(part[k]), 0);
      EXPECT_TRUE(contains(part.front(), part[k].front()));
    }
    total += area(part);
    whole = whole.empty() ? part : unite(whole, part);
  }
  EXPECT_NEAR(total, area(region), 1e-6 * area(region)) << "parts do not overlap";
  EXPECT_GT(iou(clean(whole, FillRule::kEvenOdd), clean(region, FillRule::kEvenOdd)),
            1 - 1e-6);
}

TEST(Antimeridian, CutsAreasThatCrossItOnly) {
  expect_same({square(400)}, near_180(), 1);
  expect_same({square(2000)}, near_180(), 2);
  expect_same({square(2000)}, elsewhere(), 1);
  expect_same({square(200, {0, 900})}, near_180(), 1);
}

TEST(Antimeridian, CutsHolesAndConcaveAreas) {
  Ring on_it = square(100, {0, 532});
  std::reverse(on_it.begin(), on_it.end());
  Ring west = square(100, {500, 0}), east = square(100, {-500, 1000});
  std::reverse(west.begin(), west.end());
  std::reverse(east.begin(), east.end());
  expect_same({square(2000), on_it, west, east}, near_180(), 2);
  // A comb whose three teeth reach over it: one part west of it, three east.
  const Ring comb = {{300, 0},    {300, 900},  {200, 900},  {200, 300},
                     {50, 300},   {50, 900},   {-50, 900},  {-50, 300},
                     {-200, 300}, {-200, 900}, {-300, 900}, {-300, 0}};
  expect_same({signed_area(comb) > 0 ? comb : Ring(comb.rbegin(), comb.rend())},
              near_180(), 4);
}

TEST(Antimeridian, CutsRandomRegionsIntoTheSame) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    RandomStream random(seed, 0, Purpose::kTest);
    Region region;
    for (int k = 0; k < 3; ++k) {
      Ring star;
      const Vec2 centre(600 * random.uniform(), 800 * random.uniform());
      for (int i = 0; i < 9; ++i)
        star.push_back(centre + (100 + 900 * random.uniform()) * unit(2 * kPi * i / 9));
      region = region.empty()
                   ? clean({star}, FillRule::kNonZero)
                   : subtract(unite(region, {star}), {square(60, centre + Vec2(0, 200))});
    }
    expect_same(region, near_180(), cut_region(region, near_180()).size());
  }
}

TEST(Antimeridian, PointsAndEdgesOnItMakeNoSlivers) {
  // West of it, with an edge and a corner on it.
  const auto at = [](double latitude, double longitude) {
    return near_180().to_plane(latitude, longitude);
  };
  for (const double sign : {1.0, -1.0}) {
    const double away = sign * 179.99;
    const Ring edge = {at(-16.80, away), at(-16.80, sign * 180), at(-16.81, sign * 180),
                       at(-16.81, away)};
    const Ring corner = {at(-16.80, away), at(-16.805, sign * 180), at(-16.81, away)};
    for (Ring ring : {edge, corner}) {
      if (signed_area(ring) < 0) std::reverse(ring.begin(), ring.end());
      expect_same({ring}, near_180(), 1);
      const std::vector<PlacePolygon> polygons = cut_region({ring}, near_180());
      for (const Geodetic& each : polygons.at(0).at(0))
        EXPECT_GT(sign * each.longitude_deg, 0);
    }
  }
}

TEST(Antimeridian, LeavesAnAreaAroundThePoleWhole) {
  const LocalFrame pole = LocalFrame::at({89.9, 170, 0}).value();
  EXPECT_EQ(cut_region({square(50'000)}, pole).size(), 1u);
}

TEST(Antimeridian, CutsLinesOnTheStraightWay) {
  const std::vector<Vec2> points = {{0, 0}, {100, 1000}, {200, 900}, {300, -100}};
  const auto parts = cut_line(points, near_180());
  ASSERT_EQ(parts.size(), 3u);
  std::vector<Vec2> back;
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (std::size_t i = 0; i < parts[k].size(); ++i) {
      const CutPoint& each = parts[k][i];
      const Vec2 p = near_180().to_plane(each.at.latitude_deg, each.at.longitude_deg);
      Vec2 expected = points[each.before];
      if (each.share > 0)
        expected += each.share * (points[each.before + 1] - points[each.before]);
      EXPECT_LT((p - expected).norm(), 1e-3);
      const bool end = (i == 0 && k > 0) || (i + 1 == parts[k].size() && k < 2);
      EXPECT_EQ(std::abs(each.at.longitude_deg) == 180, end) << k << ' ' << i;
      EXPECT_EQ(each.at.longitude_deg > 0, k != 1) << k << ' ' << i;
    }
}

TEST(Antimeridian, CutsNoLineElsewhere) {
  EXPECT_EQ(cut_line(std::vector<Vec2>{{0, 0}, {0, 400}}, near_180()).size(), 1u);
  EXPECT_EQ(cut_line(std::vector<Vec2>{{0, 0}, {0, 9000}}, elsewhere()).size(), 1u);
  EXPECT_EQ(cut_line(std::vector<Vec2>{{0, 0}}, near_180())[0].size(), 1u);
  // To 180 degrees and back, to it and on, from it.
  const Vec2 on = near_180().to_plane(-16.8, 180);
  const Vec2 west = on - Vec2(0, 300), east = on + Vec2(0, 300);
  const auto sizes = [](const std::vector<Vec2>& points) {
    std::vector<std::size_t> all;
    for (const auto& part : cut_line(points, near_180())) all.push_back(part.size());
    return all;
  };
  using Sizes = std::vector<std::size_t>;
  EXPECT_EQ(sizes({west, on}), Sizes{2});
  EXPECT_EQ(sizes({on, west}), Sizes{2});
  EXPECT_EQ(sizes({on, east}), Sizes{2});
  EXPECT_EQ(sizes({west, on, east}), (Sizes{2, 2}));
  EXPECT_EQ(sizes({east, on, west}), (Sizes{2, 2}));
  EXPECT_EQ(sizes({west, on, west}), (Sizes{2, 2}));
}

}  // namespace
}  // namespace skein::geo::antimeridian_test
