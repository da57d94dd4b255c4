// SPDX-License-Identifier: Apache-2.0
#include "skein/model/probability/truncated_normal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "skein/base/check.h"
#include "skein/base/random.h"

namespace skein::model::truncated_normal_test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// The standard normal on [alpha, beta] by Simpson's rule in extended precision, relative
// to the end nearer to 0. An independent reference: no erf in it.
TruncatedNormal by_quadrature(double alpha, double beta) {
  const bool mirrored = alpha + beta < 0;
  const long double a = mirrored ? -beta : alpha, b = mirrored ? -alpha : beta;
  const long double start = std::max(a, 0.0L);  // where the density is largest
  const long double low = std::max(a, -12.0L);
  const long double high = std::min(b, start + std::min(12.0L, 45.0L / (start + 1e-9L)));
  const int panels = 20000;
  const long double h = (high - low) / panels;
  long double m0 = 0, m1 = 0, m2 = 0;
  for (int k = 0; k <= panels; ++k) {
    const long double t = low - start + k * h;  // offset from the largest density
    const long double w = (k == 0 || k == panels ? 1
                           : k % 2               ? 4
                                                 : 2) *
                          std::exp(-t * (start + t / 2)) * h / 3;
    m0 += w;
    m1 += w * t;
    m2 += w * t * t;
  }
  const long double mean = m1 / m0;
  const double log_mass =
      static_cast<double>(std::log(m0) - start * start / 2) + std::log(kInvSqrt2Pi);
  return {std::exp(log_mass), log_mass,
          static_cast<double>(mirrored ? -(start + mean) : start + mean),
          static_cast<double>(m2 / m0 - mean * mean)};
}

void expect_moments(double alpha, double beta) {
  const TruncatedNormal want = by_quadrature(alpha, beta);
  const TruncatedNormal got = truncate_normal(0, 1, {alpha, beta});
  // Nearly opposite bounds give a mean near 0: then relative to the interval.
  const double scale = std::max(std::abs(want.mean), 1e-4 * std::sqrt(want.variance));
  EXPECT_NEAR(got.mean, want.mean, 1e-10 * scale) << alpha << " " << beta;
  EXPECT_NEAR(got.variance / want.variance, 1, 1e-9) << alpha << " " << beta;
  EXPECT_NEAR(got.log_mass, want.log_mass, 1e-10 * (1 + std::abs(want.log_mass)))
      << alpha << " " << beta;
  if (want.mass > 1e-300) {
    EXPECT_NEAR(got.mass / want.mass, 1, 1e-9) << alpha << " " << beta;
  }
}

TEST(TruncatedNormal, OneSidedEqualsQuadratureFromFarInsideToFarTail) {
  for (double alpha = -8; alpha < 45; alpha += 0.173) expect_moments(alpha, kInf);
  for (double beta = -45; beta < 8; beta += 0.173) expect_moments(-kInf, beta);
}

TEST(TruncatedNormal, OneSidedKeepsItsDigitsAtAThousandSigma) {
  for (double alpha : {20.0, 45.0, 49.99, 50.01, 99.0, 1e3, 1e6}) {
    // Laplace's continued fraction lambda = alpha + 1/(alpha + 2/(alpha + 3/...)): the
    // variance follows without a difference of almost equal numbers.
    long double from_2 = 0;
    for (int k = 200; k >= 2; --k) from_2 = k / (alpha + from_2);
    const long double from_1 = 1 / (alpha + from_2);
    const Moments cut = standard_above(alpha);
    EXPECT_NEAR(cut.mean / static_cast<double>(alpha + from_1), 1, 1e-14) << alpha;
    EXPECT_NEAR(cut.variance / static_cast<double>((from_2 - from_1) / (alpha + from_2)),
                1, 1e-11)
        << alpha;
  }
}

TEST(TruncatedNormal, TwoSidedEqualsQuadratureForAnyWidth) {
  for (double alpha :
       {-37.0, -9.0, -3.0, -1.0, -0.2, 0.0, 0.3, 1.0, 2.9, 6.0, 12.0, 37.0})
    for (double width : {1e-7, 1e-3, 0.1, 0.5, 1.9, 2.1, 4.0, 11.0})
      expect_moments(alpha, alpha + width);
}

TEST(TruncatedNormal, NarrowIntervalsBecomeUniform) {
  const TruncatedNormal cut = truncate_normal(3, 2, {5, 5 + 1e-6});
  EXPECT_NEAR(cut.variance / (1e-12 / 12), 1, 1e-9);
  EXPECT_NEAR(cut.mass / (1e-6 * normal_pdf(1) / 2), 1, 1e-6);
}

TEST(TruncatedNormal, KeepsTheWidthOfAnIntervalThatIsThinForItsDistance) {
  // A hundred units in the last place wide: the ends, in sigmas, have no digits to spare.
  const double lower = 1e9, width = 1e-5;
  const TruncatedNormal cut = truncate_normal(0, 1e9, {lower, lower + width});
  const double held = lower + width - lower;  // the width that doubles can hold
  EXPECT_NEAR(cut.variance / (held * held / 12), 1, 1e-9);
}

// From the thesis's formulas, derived anew; the third column is what the misprinted
// (2.26) gives instead of the variance.
TEST(TruncatedNormal, CorrectedFormulasHoldAndMisprintsDoNot) {
  struct Row {
    double mu, sigma, lower, upper, mass, mean, variance, misprint;
  };
  const Row rows[] = {
      {0, 1, 0, kInf, 0.5, 0.7978845608029, 0.3633802276324, 1},
      {0, 1, -1, 1, 0.6826894921371, 0, 0.2911250947728, 0.2911250947728},
      {0, 1, -kInf, -2, 0.02275013194818, -2.373215532823, 0.1142791004141,
       5.746431065646},
      {2, 0.5, 1, 1.5, 0.1359051219833, 1.308415476684, 0.01818572152515,
       0.4964748744151},
      {300, 100, -kInf, 0, 0.00134989803163, -28.30986549304, 705.5918678527,
       108492.9596479},
      {0, 1, 37, kInf, 5.725571222525e-300, 37.02698768613, 0.0007272780988775,
       1370.998544387},
  };
  for (const Row& row : rows) {
    const TruncatedNormal cut =
        truncate_normal(row.mu, row.sigma, {row.lower, row.upper});
    // The values are printed with 13 digits.
    EXPECT_NEAR(cut.mass / row.mass, 1, 1e-9);
    EXPECT_NEAR(cut.mean, row.mean, 1e-9 * std::abs(row.mean));
    EXPECT_NEAR(cut.variance / row.variance, 1, 1e-9);
    // Last term of (2.26) missing, as printed: phi(alpha) - phi(alpha) = 0.
    const double moved = cut.mean - row.mu;
    EXPECT_NEAR((cut.variance + moved * moved) / row.misprint, 1, 1e-9);
  }
  EXPECT_GT(truncate_normal(0, 1, {0, kInf}).mean, 0) << "(2.27) as printed: -0.798";
}

TEST(TruncatedNormal, AgreesWithSampling) {
  RandomStream random(1, 0, Purpose::kTest);
  const double mu = 50, sigma = 104;
  double n = 0, sum = 0, squares = 0;
  for (int k = 0; k < 400000; ++k) {
    const double z = mu + sigma * random.normal();
    if (z < 0) continue;
    ++n;
    sum += z;
    squares += z * z;
  }
  const TruncatedNormal cut = truncate_normal(mu, sigma, {0, kInf});
  const double mean = sum / n, sd = std::sqrt(cut.variance);
  EXPECT_NEAR(n / 400000, cut.mass, 4 * 0.5 / std::sqrt(400000.0));  // 4 sigma
  EXPECT_NEAR(mean, cut.mean, 4 * sd / std::sqrt(n));
  EXPECT_NEAR(squares / n - mean * mean, cut.variance,
              4 * cut.variance * 2 / std::sqrt(n));
}

TEST(TruncatedNormal, RefusesWhatIsNoInterval) {
  EXPECT_THROW((void)truncate_normal(0, 1, {1, 1}), Bug);
  EXPECT_THROW((void)truncate_normal(0, 0, {0, 1}), Bug);
  const TruncatedNormal whole = truncate_normal(5, 2, {});
  EXPECT_EQ(whole.mean, 5);
  EXPECT_EQ(whole.variance, 4);
  EXPECT_EQ(whole.mass, 1);
}

TEST(UncertainHalfLine, IsTheMixtureOfBothHalves) {
  for (double bound : {-3.0, 0.0, 2.5, 9.0})
    for (double eps : {0.0, 1e-9, 0.02, 0.5, 1.0}) {
      const double mean = 1, sd = 2;
      const TruncatedNormal up = truncate_normal(mean, sd, {bound, kInf});
      const TruncatedNormal down = truncate_normal(mean, sd, {-kInf, bound});
      const double likelihood = (1 - eps) * up.mass + eps * down.mass;
      const double w = (1 - eps) * up.mass / likelihood, v = eps * down.mass / likelihood;
      const double m = w * up.mean + v * down.mean;
      const double second = w * (up.variance + (up.mean - m) * (up.mean - m)) +
                            v * (down.variance + (down.mean - m) * (down.mean - m));
      const MixtureMoments got = uncertain_half_line(mean, sd, bound, 1 - eps, eps);
      EXPECT_NEAR(got.likelihood / likelihood, 1, 1e-12);
      EXPECT_NEAR(got.mean, m, 1e-11);
      EXPECT_NEAR(got.variance / second, 1, 1e-10);
    }
}

TEST(UncertainHalfLine, AnUninformativeReadingTeachesNothing) {
  const MixtureMoments got = uncertain_half_line(1, 2, 4, 0.5, 0.5);
  EXPECT_NEAR(got.mean, 1, 1e-14);
  EXPECT_NEAR(got.variance, 4, 1e-13);
}

TEST(UncertainHalfLine, AnImpossibleReadingIsTakenForAnError) {
  // 60 sigma away the reading is certainly false, if it can be false at all.
  const MixtureMoments mixture = uncertain_half_line(0, 1, 60, 0.99, 0.01);
  EXPECT_NEAR(mixture.mean, 0, 1e-12);
  EXPECT_NEAR(mixture.variance, 1, 1e-12);
  const MixtureMoments trusted = uncertain_half_line(0, 1, 60, 1, 0);
  EXPECT_NEAR(trusted.mean, 60 + 1.0 / 60, 1e-4);
  EXPECT_EQ(trusted.likelihood, 0) << "underflow; the moments do not";
}

}  // namespace
}  // namespace skein::model::truncated_normal_test
