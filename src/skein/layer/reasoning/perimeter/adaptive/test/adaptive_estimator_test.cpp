// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/adaptive/adaptive_estimator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "skein/layer/reasoning/perimeter/test/weaving.h"

namespace skein::perimeter::adaptive_estimator_test {
namespace {

PerimeterPrior prior() {
  PerimeterPrior p;
  p.radius = 400;
  p.radius_sd = 100;
  p.rate = 0.2;
  p.rate_sd = 0.1;
  p.wind_sd = 0.05;
  return p;
}

// A small, coarse ensemble: the tests are about when it takes over.
AdaptiveOptions quick() {
  AdaptiveOptions options;
  options.ensemble.members = 24;
  options.ensemble.cell = 20;
  return options;
}

// An L whose long arm a look from the origin does not see round the corner.
geo::Ring corner_shape() {
  return {{-300, -300}, {900, -300}, {900, -100}, {-50, -100}, {-50, 1100}, {-300, 1100}};
}

double overlap_error(const BoundaryEstimate& belief, const geo::Ring& truth) {
  double worst = 0;
  for (const auto& ring : belief.rings)
    for (const BoundaryPoint& point : ring) {
      double nearest = 1e9;
      for (std::size_t i = 0; i < truth.size(); ++i) {
        const Vec2 a = truth[i], edge = truth[(i + 1) % truth.size()] - a;
        const double u =
            std::clamp((point.position - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
        nearest = std::min(nearest, (point.position - a - u * edge).norm());
      }
      worst = std::max(worst, nearest);
    }
  return worst;
}

TEST(Adaptive, StaysWithJointOnARoundFire) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    AdaptiveEstimator estimator(prior(), quick());
    Weaving(wavy(seed, 3, 25), seed).fly(estimator, 1, 900);
    EXPECT_FALSE(estimator.handed_over()) << seed;
    EXPECT_EQ(estimator.health().method, "joint");
    EXPECT_EQ(estimator.boundary().rings[0].size(), 60U);
  }
}

TEST(Adaptive, HandsOverWhereTheFireIsNotStarShaped) {
  for (const std::uint64_t seed : {1, 2}) {
    AdaptiveEstimator estimator(prior(), quick());
    Weaving weaving(corner_shape(), seed);
    weaving.fly(estimator, 1, 1200);
    EXPECT_TRUE(estimator.handed_over()) << seed;
    EXPECT_EQ(estimator.health().method, "ensemble");
    EXPECT_LT(overlap_error(estimator.boundary(), corner_shape()), 120) << seed;
  }
}

TEST(Adaptive, FalseReadingsAreNoReasonToHandOver) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    AdaptiveEstimator estimator(prior(), quick());
    Weaving(wavy(seed, 3, 25), seed, 0.02).fly(estimator, 1, 900);
    EXPECT_FALSE(estimator.handed_over()) << seed;
  }
}

TEST(Adaptive, ACloneContinuesAsTheOriginal) {
  AdaptiveEstimator estimator(prior(), quick());
  Weaving weaving(corner_shape(), 4);
  weaving.fly(estimator, 1, 400);
  const auto clone = estimator.clone();
  Weaving other = weaving;
  weaving.fly(estimator, 400, 700);
  other.fly(*clone, 400, 700);
  const BoundaryEstimate a = estimator.boundary(), b = clone->boundary();
  ASSERT_EQ(a.rings.size(), b.rings.size());
  ASSERT_EQ(a.rings[0].size(), b.rings[0].size());
  for (std::size_t i = 0; i < a.rings[0].size(); ++i) {
    EXPECT_EQ(a.rings[0][i].position, b.rings[0][i].position);
    EXPECT_EQ(a.rings[0][i].sigma, b.rings[0][i].sigma);
  }
}

}  // namespace
}  // namespace skein::perimeter::adaptive_estimator_test
