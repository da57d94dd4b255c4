// SPDX-License-Identifier: Apache-2.0
#include "skein/model/front/wavelet.h"

#include <gtest/gtest.h>

#include <limits>

namespace skein::model::wavelet_test {
namespace {

// Speed of the front along its normal: the support function of the wavelet.
double normal_speed(const Wavelet& w, const Vec2& n) {
  return spread_velocity(w, n).dot(n);
}

TEST(Wavelet, MovesHeadFlankAndBackAtTheirRates) {
  const Wavelet w{geo::unit(0.7), 3, 1, 2};
  EXPECT_LT((spread_velocity(w, geo::unit(0.7)) - 5 * geo::unit(0.7)).norm(), 1e-14);
  EXPECT_LT((spread_velocity(w, -geo::unit(0.7)) + 1 * geo::unit(0.7)).norm(), 1e-14);
  EXPECT_NEAR(normal_speed(w, geo::unit(0.7 + geo::kPi / 2)), 1, 1e-14);
}

TEST(Wavelet, VelocityIsThePointOfTheEllipseWithThatNormal) {
  // The largest extent of the ellipse along n, by search over its points.
  const Wavelet w{geo::unit(-1.1), 2.5, 0.6, 1.9};
  for (double bearing : {0.0, 0.3, 1.5, 2.9, -2.0}) {
    const Vec2 n = geo::unit(bearing);
    double max = -1e9;
    for (int i = 0; i < 20000; ++i) {
      const double u = 2 * geo::kPi * i / 20000;
      const Vec2 p = (w.drift + w.length * std::cos(u)) * w.heading +
                     w.width * std::sin(u) * geo::turned_right(w.heading);
      max = std::max(max, p.dot(n));
    }
    EXPECT_NEAR(spread_velocity(w, 7 * n).dot(n), max,
                1e-6);  // 20000 points: 2.5 (pi/2e4)^2 / 2
  }
}

TEST(Wavelet, NothingMovesWithoutRateOrNormal) {
  EXPECT_EQ(spread_velocity(Wavelet{}, Vec2(1, 0)), Vec2(0, 0));
  EXPECT_EQ(spread_velocity(Wavelet{{1, 0}, 1, 1, 0}, Vec2(0, 0)), Vec2(0, 0));
}

TEST(LengthToBreadth, IsRoundInStillAirAndBounded) {
  EXPECT_NEAR(length_to_breadth(0), 1, 1e-15);
  // 0.936 e^1.283 + 0.461 e^-0.774 - 0.397 = 3.37657 + 0.21260 - 0.397.
  EXPECT_NEAR(length_to_breadth(5), 3.19217, 1e-5);
  EXPECT_EQ(length_to_breadth(1e300), 8);
}

TEST(SpreadWavelet, IsACircleInStillAirOnLevelGround) {
  const Wavelet w = spread_wavelet({}, Vec2::Zero(), Vec2::Zero(), 1.5);
  EXPECT_DOUBLE_EQ(w.length, 0.05 * 1.5);
  EXPECT_DOUBLE_EQ(w.width, 0.05 * 1.5);
  EXPECT_DOUBLE_EQ(w.drift, 0);
}

TEST(SpreadWavelet, HeadRateGrowsLinearlyWithWindAndPointsDownwind) {
  const SpreadLaw law{0.1, 0.5, 0.6, geo::radians(10)};
  const Vec2 wind(0, 8);
  const Wavelet w = spread_wavelet(law, wind, Vec2::Zero(), 1);
  EXPECT_NEAR(w.length + w.drift, 0.1 * (1 + 0.6 * 0.5 * 8), 1e-12);
  EXPECT_LT((w.heading - Vec2(0, 1)).norm(), 1e-15);
  EXPECT_NEAR(w.length / w.width, length_to_breadth(4), 1e-12);
  EXPECT_GT(w.length, w.drift);
  // The focus of the ellipse is where it was lit: drift^2 = length^2 - width^2.
  EXPECT_NEAR(w.drift * w.drift, w.length * w.length - w.width * w.width, 1e-12);
}

TEST(SpreadWavelet, SlopeDoublesTheRateEveryTenDegrees) {
  SpreadLaw law;
  for (double angle_deg : {10.0, 20.0, 30.0}) {
    const Vec2 up = std::tan(geo::radians(angle_deg)) * geo::unit(2.0);
    const Wavelet w = spread_wavelet(law, Vec2::Zero(), up, 1);
    EXPECT_NEAR(w.length + w.drift, law.rate * std::exp2(angle_deg / 10), 1e-12);
    EXPECT_LT((w.heading - geo::unit(2.0)).norm(), 1e-12);
  }
  law.slope_doubling = 0;
  EXPECT_DOUBLE_EQ(spread_wavelet(law, Vec2::Zero(), Vec2(0.5, 0), 1).drift, 0);
}

TEST(SpreadWavelet, OppositeWindAndSlopeCanCancel) {
  const SpreadLaw law{0.1, 1, 1, geo::radians(10)};
  const Vec2 up = std::tan(geo::radians(10)) * Vec2(1, 0);  // phi 1 north
  const Wavelet w = spread_wavelet(law, Vec2(-1, 0), up, 1);
  EXPECT_NEAR(w.drift, 0, 1e-6);  // the root of LB^2 - 1 magnifies rounding
  EXPECT_NEAR(w.length, 0.1, 1e-6);
}

TEST(SpreadWavelet, StaysFiniteForExtremes) {
  for (double wind : {0.0, 1e-9, 50.0, 1e6}) {
    for (double slope : {0.0, 1e-9, 1.0, 1e6}) {
      const Wavelet w = spread_wavelet({}, Vec2(wind, 0), Vec2(0, slope), 1);
      EXPECT_TRUE(std::isfinite(w.length) && std::isfinite(w.width) &&
                  std::isfinite(w.drift));
      EXPECT_GE(w.length, w.width);
      EXPECT_GE(w.length, w.drift);
      EXPECT_NEAR(w.heading.norm(), 1, 1e-12);
    }
  }
}

TEST(SpreadWavelet, StaysFiniteWhenTheSmallestSlopeDoubles) {
  SpreadLaw law;
  law.slope_doubling = 1e-9;
  const Wavelet w = spread_wavelet(law, Vec2(5, 0), Vec2(0, 0.5), 1);
  EXPECT_NEAR(w.length + w.drift, law.rate * (1 + 60 * law.wind_response), 1e-12);
  EXPECT_LT((w.heading - Vec2(0, 1)).norm(), 1e-6);
}

TEST(SpreadLaw, RefusesImpossibleValues) {
  EXPECT_TRUE(check(SpreadLaw{}).ok());
  EXPECT_FALSE(check(SpreadLaw{-1, 0.4, 0.8, 0.1}).ok());
  EXPECT_FALSE(check(SpreadLaw{0.1, 0.4, 0, 0.1}).ok());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(check(SpreadLaw{nan, 0.4, 0.8, 0.1}).ok());
  EXPECT_FALSE(check(SpreadLaw{0.1, nan, 0.8, 0.1}).ok());
  EXPECT_FALSE(check(SpreadLaw{0.1, 0.4, 0.8, nan}).ok());
}

}  // namespace
}  // namespace skein::model::wavelet_test
