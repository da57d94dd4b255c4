// SPDX-License-Identifier: Apache-2.0
#include "skein/geo/contour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "skein/base/random.h"
#include "skein/geo/clip.h"

namespace skein::geo::contour_test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(Contour, OfADistanceFieldIsTheCircle) {
  const double spacing = 5, radius = 73;
  const Vec2 low(-100, -120), centre(3.3, -4.1);
  const int rows = 41, columns = 49;
  std::vector<double> values;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      values.push_back((low + spacing * Vec2(r, c) - centre).norm());
  const Region region = contour(values, rows, columns, low, spacing, radius);
  ASSERT_EQ(region.size(), 1u);
  // Linear interpolation of a distance: error up to spacing^2 / (8 radius) = 0.043 m.
  for (const Vec2& p : region[0]) EXPECT_NEAR((p - centre).norm(), radius, 0.045);
  EXPECT_GT(signed_area(region[0]), 0);
  // As a share of the area: twice the largest radial error (edge sag and crossing).
  EXPECT_NEAR(area(region) / (kPi * radius * radius), 1, 4 * 0.045 / radius);
}

TEST(Contour, HolesAreNegativeAndIslandsInThemPositive) {
  const int n = 61;
  std::vector<double> values;  // below 0 from radius 5 to 15
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const double radius = Vec2(r - 30, c - 30).norm();
      values.push_back(radius < 20 ? std::cos(radius * 2 * kPi / 20) : 1.0);
    }
  const auto areas = [&] {
    std::vector<double> found;
    for (const Ring& ring : contour(values, n, n, Vec2::Zero(), 1, 0))
      found.push_back(signed_area(ring));
    std::sort(found.begin(), found.end());
    return found;
  };
  // Crossings are within 0.05 of the circles, edges up to 1.4 long sag by 0.05 at most.
  const double inner = kPi * 25, outer = kPi * 225;
  std::vector<double> found = areas();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0], -inner, 0.1 * 2 * kPi * 5);
  EXPECT_NEAR(found[1], outer, 0.1 * 2 * kPi * 15);

  for (double& v : values) v = -v;  // now a square with a hole with an island
  found = areas();
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[0], -outer, 0.1 * 2 * kPi * 15);
  EXPECT_NEAR(found[1], inner, 0.1 * 2 * kPi * 5);
  EXPECT_DOUBLE_EQ(found[2], 3600);
}

TEST(Contour, ClosesAlongTheEdgeOfTheGrid) {
  const std::vector<double> values(20, -1.0);
  const Region region = contour(values, 4, 5, Vec2(10, 20), 2, 0);
  ASSERT_EQ(region.size(), 1u);
  EXPECT_DOUBLE_EQ(area(region), 6.0 * 8.0);
  EXPECT_TRUE(contains(region, Vec2(15.9, 27.9)));
}

TEST(Contour, SaddleJoinsTheLowerDiagonalWhenTheBilinearSaddleIsBelow) {
  // Corners SW, SE, NW, NE; the saddle value is (ad - bc) / (a + d - b - c).
  const auto rings = [](double sw, double se, double nw, double ne) {
    return contour(std::vector<double>{sw, se, nw, ne}, 2, 2, Vec2::Zero(), 1, 0).size();
  };
  EXPECT_EQ(rings(-3, 1, 1, -3), 1u);
  EXPECT_EQ(rings(-1, 3, 3, -1), 2u);
  EXPECT_EQ(rings(1, -3, -3, 1), 1u);
  EXPECT_EQ(rings(3, -1, -1, 3), 2u);
  EXPECT_EQ(rings(-3, kInf, kInf, -3), 2u);
}

TEST(Contour, NotFiniteValuesCountAndCutInTheMiddle) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> values{kInf, kInf, nan, kInf, -kInf, kInf, nan, kInf, kInf};
  const Region region = contour(values, 3, 3, Vec2(-1, -1), 1, 0);
  ASSERT_EQ(region.size(), 1u);
  EXPECT_DOUBLE_EQ(area(region), 0.5);  // the diamond with half diagonals of 1/2
}

TEST(Contour, EmptyGridsAndLinesHaveNoArea) {
  EXPECT_TRUE(contour({}, 0, 0, Vec2::Zero(), 1, 0).empty());
  EXPECT_TRUE(contour(std::vector<double>{-1, -1, -1}, 1, 3, Vec2::Zero(), 1, 0).empty());
  EXPECT_TRUE(contour(std::vector<double>{1, 1, 1, 1}, 2, 2, Vec2::Zero(), 1, 1).empty());
}

// Noise is the worst case: every second cell is a saddle, whole nodes stand alone, values
// equal the level exactly.
TEST(Contour, OfNoiseSeparatesEveryNodeAndIsAlreadyClean) {
  RandomStream random(7, 0, Purpose::kTest);
  for (int trial = 0; trial < 200; ++trial) {
    const int rows = 2 + static_cast<int>(random.uniform(0, 12));
    const int columns = 2 + static_cast<int>(random.uniform(0, 12));
    std::vector<double> values;
    for (int i = 0; i < rows * columns; ++i) {
      const double u = random.uniform(-4, 4);
      values.push_back(trial % 2 == 0 ? u : std::floor(u));
    }
    const Region region = contour(values, rows, columns, Vec2::Zero(), 10, 0);
    for (int r = 1; r + 1 < rows; ++r)
      for (int c = 1; c + 1 < columns; ++c) {
        const double v = values[static_cast<std::size_t>(r * columns + c)];
        if (v == 0) continue;  // there the ring passes within a millionth of the spacing
        EXPECT_EQ(contains(region, 10 * Vec2(r, c)), v < 0) << r << " " << c;
      }
    // Rings that crossed or were wound wrongly would change under the clean-up. Its
    // rounding to 0.1 mm moves an edge of at most 14 m by less than 0.1 mm.
    const Region cleaned = clean(region, FillRule::kPositive);
    EXPECT_NEAR(area(cleaned), area(region), 1e-4 * length(region) + 1e-9);
  }
}

}  // namespace
}  // namespace skein::geo::contour_test
