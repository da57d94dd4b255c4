// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/tuning/simplex_search.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::campaign::simplex_search_test {
namespace {

using Point = std::vector<double>;

double valley(const Point& x) {
  return 100 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1 - x[0], 2);
}

TEST(SimplexSearch, FindsTheEndOfACurvedValley) {
  SimplexOptions options;
  options.evaluations = 400;
  options.min = 1e-7;
  const SimplexResult result =
      simplex_search([](const Point& x) { return valley(x); }, {-1.2, 1}, options);
  EXPECT_FALSE(result.stopped);
  EXPECT_LT(result.tries.size(), 400u) << "it knows when it is there";
  // Near the minimum the cost goes with the square of the distance.
  EXPECT_NEAR(result.best.at[0], 1, 1e-5);
  EXPECT_NEAR(result.best.at[1], 1, 1e-5);
}

TEST(SimplexSearch, ComesDownInEightDimensions) {
  const auto bowl = [](const Point& x) -> std::optional<double> {
    double sum = 1;
    for (std::size_t i = 0; i < x.size(); ++i)
      sum += (1.0 + static_cast<double>(i)) *
             std::pow(x[i] - 0.1 * static_cast<double>(i), 2);
    return sum;
  };
  SimplexOptions options;
  options.evaluations = 2000;
  options.min = 1e-4;
  const SimplexResult result = simplex_search(bowl, Point(8, 0.0), options);
  // From 1 + sum of (1 + i) (i / 10)^2 = 10.24 down to within 1 % of the minimum.
  EXPECT_NEAR(result.tries.front().cost, 10.24, 1e-9);
  EXPECT_LT(result.best.cost, 1.01);
}

TEST(SimplexSearch, KeepsToItsBudgetAndKnowsTheBestOfAllTried) {
  SimplexOptions options;
  options.evaluations = 17;
  const SimplexResult result =
      simplex_search([](const Point& x) { return valley(x); }, {-1.2, 1}, options);
  ASSERT_EQ(result.tries.size(), 17u);
  EXPECT_EQ(result.tries.front().at, (Point{-1.2, 1}));
  for (const SimplexTry& each : result.tries) {
    EXPECT_LE(result.best.cost, each.cost);
    EXPECT_EQ(each.cost, valley(each.at));
  }
}

TEST(SimplexSearch, EndsWhenNoCostIsGiven) {
  int calls = 0;
  const auto cost = [&](const Point& x) -> std::optional<double> {
    return ++calls <= 5 ? std::optional(valley(x)) : std::nullopt;
  };
  const SimplexResult some = simplex_search(cost, {-1.2, 1}, {});
  EXPECT_TRUE(some.stopped);
  EXPECT_EQ(some.tries.size(), 5u);
  const SimplexResult none = simplex_search(cost, {-1.2, 1}, {});
  EXPECT_TRUE(none.stopped);
  EXPECT_TRUE(none.best.at.empty());
}

}  // namespace
}  // namespace skein::campaign::simplex_search_test
