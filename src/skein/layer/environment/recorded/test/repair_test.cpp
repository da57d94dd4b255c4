// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "skein/base/random.h"
#include "skein/geo/boundary_index.h"
#include "skein/geo/clip.h"
#include "skein/layer/environment/recorded/distance_grid.h"
#include "skein/layer/environment/recorded/perimeter_repair.h"

namespace skein::environment::repair_test {
namespace {

using geo::Region;
using Warnings = std::vector<std::string>;

std::vector<Vec2> square(double north, double east, double side) {
  return {{north, east},
          {north, east + side},
          {north + side, east + side},
          {north + side, east},
          {north, east}};  // closed, as files have it
}

RawPerimeter of_polygon(double time, std::vector<Vec2> outer,
                        std::vector<std::vector<Vec2>> holes = {}) {
  return {time, "t", {{std::move(outer), std::move(holes)}}, {}};
}

bool mentions(const Warnings& warnings, const std::string& text) {
  return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& w) {
    return w.find(text) != std::string::npos;
  });
}

// Rounding to 0.1 mm along the boundaries used here (up to some km) moves less than this.
constexpr double kArea = 0.5;  // [m^2]

TEST(Repaired, GoodPolygonsPassWithoutAWord) {
  Warnings warnings;
  RawPerimeter raw = of_polygon(0, square(0, 0, 100), {square(40, 40, 20)});
  raw.polygons.push_back({square(200, 0, 50), {}});
  std::reverse(raw.polygons[1].outer.begin(), raw.polygons[1].outer.end());
  const Region region = repaired(raw, {}, warnings);
  EXPECT_EQ(warnings, Warnings());
  EXPECT_EQ(region.size(), 3u);
  EXPECT_NEAR(geo::area(region), 10000 - 400 + 2500, kArea);
  EXPECT_FALSE(geo::contains(region, Vec2(50, 50)));
  EXPECT_TRUE(geo::contains(region, Vec2(225, 25)));
}

TEST(Repaired, IslandWithinAHoleAndOverlapsAreUnited) {
  Warnings warnings;
  RawPerimeter raw = of_polygon(0, square(0, 0, 100), {square(20, 20, 60)});
  raw.polygons.push_back({square(40, 40, 20), {}});   // in the hole
  raw.polygons.push_back({square(50, 90, 100), {}});  // over the rim
  const Region region = repaired(raw, {}, warnings);
  EXPECT_NEAR(geo::area(region), 10000 - 3600 + 400 + 10000 - 50 * 10, kArea);
}

TEST(Repaired, RingsThatCrossThemselvesEncloseBothLobes) {
  Warnings warnings;
  // A bow tie: its signed area is zero, its two triangles have 2500 m2 each.
  const Region bow =
      repaired(of_polygon(0, {{0, 0}, {100, 100}, {0, 100}, {100, 0}}), {}, warnings);
  EXPECT_NEAR(geo::area(bow), 5000, kArea);
  EXPECT_TRUE(mentions(warnings, "crosses itself"));
  warnings.clear();
  // A square walked around twice counts once.
  auto twice = square(0, 0, 100);
  const auto again = twice;
  twice.insert(twice.end(), again.begin(), again.end());
  EXPECT_NEAR(geo::area(repaired(of_polygon(0, twice), {}, warnings)), 10000, kArea);
  EXPECT_TRUE(mentions(warnings, "crosses itself"));
}

TEST(Repaired, LinesAreJoinedClosedAndNested) {
  Warnings warnings;
  RawPerimeter raw{0, "t", {}, {}};
  // Outer square in three pieces, one backwards, ends up to half a metre apart, the last
  // side missing; inside it a closed line: an island.
  raw.lines = {{{0, 0}, {0, 100}},
               {{100, 100}, {0.3, 100.4}},
               {{100, 100.5}, {100, 0}},
               square(40, 40, 20)};
  const Region region = repaired(raw, {}, warnings);
  EXPECT_NEAR(geo::area(region), 10000 - 400, 60);  // the ends' half metres over 100 m
  EXPECT_FALSE(geo::contains(region, Vec2(50, 50)));
  EXPECT_TRUE(mentions(warnings, "closed over 100 m"));
}

TEST(Repaired, WhatHasNoAreaIsLeftOut) {
  Warnings warnings;
  RawPerimeter raw = of_polygon(0, square(0, 0, 100));
  raw.polygons.push_back({{}, {}});
  raw.polygons.push_back({{{5, 5}}, {}});
  raw.polygons.push_back({{{200, 0}, {300, 0}, {250, 0}}, {}});
  raw.polygons.push_back({square(500, 500, 0.5), {}});
  raw.lines = {{}, {{0, 300}, {0, 400}}};
  const Region region = repaired(raw, {}, warnings);
  EXPECT_EQ(region.size(), 1u);
  EXPECT_NEAR(geo::area(region), 10000, kArea);
  EXPECT_TRUE(mentions(warnings, "no area"));
  EXPECT_TRUE(mentions(warnings, "below 1 m2"));
}

std::vector<Perimeter> series_of(std::vector<RawPerimeter> raw, Warnings& warnings,
                                 const RepairOptions& options = {}) {
  double first = 0;
  auto series = growing_series(std::move(raw), options, "file", first, warnings);
  EXPECT_TRUE(series.ok()) << series.error().text();
  return series.ok() ? std::move(series).value() : std::vector<Perimeter>();
}

void expect_growing(const std::vector<Perimeter>& series) {
  for (std::size_t i = 1; i < series.size(); ++i) {
    EXPECT_GT(series[i].time, series[i - 1].time);
    EXPECT_NEAR(geo::area(geo::subtract(series[i - 1].region, series[i].region)), 0,
                kArea);
  }
}

TEST(GrowingSeries, SortsAndCountsFromTheFirst) {
  Warnings warnings;
  const auto series =
      series_of({of_polygon(500, square(0, 0, 200)), of_polygon(200, square(0, 0, 100)),
                 of_polygon(900, square(0, 0, 300))},
                warnings);
  ASSERT_EQ(series.size(), 3u);
  EXPECT_EQ(series[0].time, 0);
  EXPECT_EQ(series[2].time, 700);
  expect_growing(series);
  EXPECT_TRUE(mentions(warnings, "sorted"));
}

TEST(GrowingSeries, FeaturesOfOneTimeAreOnePerimeter) {
  Warnings warnings;
  const auto series = series_of(
      {of_polygon(0, square(0, 0, 100)), of_polygon(0, square(0, 200, 100))}, warnings);
  ASSERT_EQ(series.size(), 1u);
  EXPECT_NEAR(geo::area(series[0].region), 20000, kArea);
}

TEST(GrowingSeries, AShrinkingOneIsReportedAndUnited) {
  Warnings warnings;
  const auto series =
      series_of({of_polygon(0, square(0, 0, 100)), of_polygon(10, square(0, 0, 200)),
                 of_polygon(20, square(0, 0, 180)), of_polygon(30, square(0, 0, 300))},
                warnings);
  ASSERT_EQ(series.size(), 4u);
  EXPECT_NEAR(geo::area(series[2].region), 40000, kArea);
  expect_growing(series);
  EXPECT_TRUE(mentions(warnings, "united")) << ::testing::PrintToString(warnings);
}

TEST(GrowingSeries, AFirstRoughBoxIsAnOutlierWhenTheNextTwoAgree) {
  const std::vector<RawPerimeter> raw{
      of_polygon(0, square(-300, -300, 900)), of_polygon(10, square(0, 0, 200)),
      of_polygon(20, square(0, 0, 220)), of_polygon(30, square(0, 0, 300))};
  Warnings warnings;
  auto series = series_of(raw, warnings);
  ASSERT_EQ(series.size(), 3u);
  EXPECT_NEAR(geo::area(series[0].region), 40000, kArea);
  EXPECT_EQ(series[2].time, 20);
  EXPECT_TRUE(mentions(warnings, "outlier"));

  RepairOptions options;
  options.outliers = Outliers::kUnite;
  warnings.clear();
  series = series_of(raw, warnings, options);
  ASSERT_EQ(series.size(), 4u);
  EXPECT_NEAR(geo::area(series[3].region), 810000, kArea);
  EXPECT_TRUE(mentions(warnings, "united"));

  options.outliers = Outliers::kRefuse;
  double first = 0;
  const auto refused = growing_series(raw, options, "file", first, warnings);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().text().find("outlier"), std::string::npos);

  options.skip = {0};
  warnings.clear();
  EXPECT_EQ(series_of(raw, warnings, options).size(), 3u);
  EXPECT_EQ(warnings, Warnings());
}

TEST(GrowingSeries, AMiddleOneAwayFromBothNeighboursIsAnOutlier) {
  Warnings warnings;
  const auto series = series_of(
      {of_polygon(0, square(0, 0, 100)), of_polygon(10, square(5000, 5000, 100)),
       of_polygon(20, square(0, 0, 200))},
      warnings);
  ASSERT_EQ(series.size(), 2u);
  EXPECT_NEAR(geo::area(series[1].region), 40000, kArea);
  EXPECT_EQ(series[1].time, 20);
}

TEST(GrowingSeries, RefusesWhatCannotBeUsed) {
  Warnings warnings;
  double first = 0;
  EXPECT_FALSE(growing_series({}, {}, "file", first, warnings).ok());
  EXPECT_FALSE(
      growing_series({of_polygon(0, {{0, 0}, {1, 1}})}, {}, "file", first, warnings)
          .ok());
  RepairOptions options;
  options.skip = {1};
  const auto refused =
      growing_series({of_polygon(0, square(0, 0, 9))}, options, "file", first, warnings);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().text().find("number 1"), std::string::npos);
}

TEST(Projected, RefusesAFireFarFromTheOrigin) {
  const auto frame = geo::LocalFrame::at({38.9, -121, 0}).value();
  const auto near = projected(of_polygon(0, {{38.91, -121.01}}), frame);
  ASSERT_TRUE(near.ok());
  EXPECT_NEAR(near.value().polygons[0].outer[0].x(), 1110, 5);  // 0.01 deg of latitude
  for (const Vec2& far : {Vec2(48.9, -121), Vec2(-38.9, 59), Vec2(38.9, 100)})
    EXPECT_FALSE(projected(of_polygon(0, {far}), frame).ok()) << far.transpose();
}

TEST(SignedDistance, MatchesTheExactIndexEverywhere) {
  // A star with a hole and an island, partly outside the grid.
  Region region;
  geo::Ring star;
  for (int i = 0; i < 40; ++i)
    star.push_back((i % 2 == 0 ? 400.0 : 150.0) * geo::unit(2 * geo::kPi * i / 40));
  region.push_back(star);
  region.push_back({{-60, -60}, {60, -60}, {60, 60}, {-60, 60}});
  region.push_back({{600, 0}, {600, 90}, {690, 90}, {690, 0}});
  const GridShape shape{Vec2(-380, -500), 10, 90, 100};
  const GridField field = signed_distance(region, shape);
  const geo::BoundaryIndex index(region);
  double worst = 0;
  for (int r = 0; r < shape.rows; ++r)
    for (int c = 0; c < shape.columns; ++c) {
      const double exact = index.signed_distance(shape.node(r, c));
      const double error = std::abs(field.value(r, c) - exact);
      // Near the boundary, where it decides, it is exact.
      if (std::abs(exact) < 10) {
        EXPECT_NEAR(field.value(r, c), exact, 1e-9);
      }
      worst = std::max(worst, error);
    }
  EXPECT_LT(worst, 0.1 * shape.spacing);
}

}  // namespace
}  // namespace skein::environment::repair_test
