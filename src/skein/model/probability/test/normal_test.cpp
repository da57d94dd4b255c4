// SPDX-License-Identifier: Apache-2.0
#include "skein/model/probability/normal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "skein/base/check.h"

namespace skein::model::normal_test {
namespace {

// Laplace's continued fraction for the Mills ratio, in extended precision; 4000 terms are
// converged to beyond double for x >= 0.3.
double mills_by_fraction(double x) {
  long double tail = 0;
  for (int k = 4000; k >= 1; --k) tail = k / (x + tail);
  return static_cast<double>(1 / (x + tail));
}

TEST(Erfcx, AgreesWithTheStandardErfcWhereThatIsNormal) {
  for (double x = -5; x < 26; x += 0.0137) {
    // exp() amplifies the rounding of its argument, x^2 up to 676, to about 1e-13.
    const double reference =
        static_cast<double>(std::exp(static_cast<long double>(x) * x) *
                            std::erfc(static_cast<long double>(x)));
    EXPECT_NEAR(erfcx(x) / reference, 1, 2e-15 + 1e-15 * x * x * (x < 0)) << x;
  }
}

TEST(Erfcx, HasItsAsymptoteFarOut) {
  for (double x : {1e3, 1e8, 1e150}) EXPECT_NEAR(erfcx(x) * x * std::sqrt(M_PI), 1, 1e-6);
}

TEST(MillsRatio, EqualsLaplacesContinuedFraction) {
  for (double x = 0.3; x < 60; x *= 1.07)
    EXPECT_NEAR(mills_ratio(x) / mills_by_fraction(x), 1, 4e-15) << x;
}

TEST(NormalUpper, IsAccurateInBothTails) {
  // Published values of the upper tail, rounded to the digits shown.
  EXPECT_NEAR(normal_upper(8) / 6.220960574271784e-16, 1, 1e-12);
  EXPECT_NEAR(normal_upper(2) / 0.022750131948179207, 1, 1e-14);
  EXPECT_NEAR(normal_upper(37) / 5.725571222524e-300, 1, 1e-12);
  for (double x = -37; x < 37; x += 0.11)
    EXPECT_NEAR(normal_upper(x) + normal_cdf(x), 1, 3e-16) << x;
}

TEST(LogNormalUpper, ContinuesWhereTheMassUnderflows) {
  for (double x = -9; x < 37; x += 0.23)
    EXPECT_NEAR(log_normal_upper(x), std::log(normal_upper(x)),
                1e-12 * (1 + std::abs(std::log(normal_upper(x)))))
        << x;
  // log(phi(x)/x) with the first correction; the next is 3/x^4 = 3e-12.
  EXPECT_NEAR(log_normal_upper(1000), -5e5 - std::log(std::sqrt(2 * M_PI) * 1000) - 1e-6,
              1e-9);
  EXPECT_LT(log_normal_upper(-38), 0) << "a mass just under 1 is still under 1";
}

TEST(GaussianCrps, IsTheIntegralOfTheSquaredDifferenceOfDistributions) {
  for (double value : {-3.0, 0.4, 2.0, 9.0}) {
    const double mean = 1, sd = 2, step = 1e-3;
    double sum = 0;
    for (double x = -20 + step / 2; x < 22; x += step) {
      const double f = normal_cdf((x - mean) / sd) - (x > value ? 1 : 0);
      sum += f * f * step;
    }
    // The midpoint rule errs by a step at the jump.
    EXPECT_NEAR(gaussian_crps(mean, sd, value), sum, 1e-3);
  }
}

TEST(GaussianCrps, OfACertainForecastIsItsError) {
  EXPECT_DOUBLE_EQ(gaussian_crps(3, 0, 7), 4);
  EXPECT_NEAR(gaussian_crps(3, 1e-9, 7), 4, 1e-8);
}

}  // namespace
}  // namespace skein::model::normal_test
