// SPDX-License-Identifier: Apache-2.0
#include "skein/model/probability/range_rule.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::model::range_rule_test {
namespace {

constexpr Side kAbove = Side::kAbove, kBelow = Side::kBelow;

TEST(MapValue, ReproducesReferenceValues) {
  struct Row {
    double sigma, bound;
    Side side;
    double sigma_v, want;
  };
  const Row rows[] = {
      {1, -1, kAbove, 0.1, 7.694598626706e-22},  {1, 0, kAbove, 0.1, 0.2378450438078},
      {1, 2, kAbove, 0.1, 2.122337958280},       {1, -2, kBelow, 0.1, -2.122337958280},
      {30, -50, kAbove, 5, 1.385027752807e-20},  {104, -200, kBelow, 10, -212.7563994660},
      {104, -50, kAbove, 10, 0.001606744933660}, {1, 0, kAbove, 1, 0.5060544689892},
  };
  for (const Row& row : rows)
    EXPECT_NEAR(map_value(0, row.sigma, row.bound, row.side, row.sigma_v) / row.want, 1,
                1e-9)
        << row.sigma << " " << row.bound;
}

TEST(MapValue, IsWhereTheLogPosteriorIsFlat) {
  for (double sigma : {0.5, 30.0})
    for (double bound : {-70.0, -3.0, 0.0, 4.0, 200.0})
      for (double sigma_v : {0.05, 2.0, 400.0}) {
        const double mean = 2;
        const auto slope = [&](double z) {
          const double w = (z - bound) / sigma_v;
          return standard_above(-w).mean / sigma_v - (z - mean) / (sigma * sigma);
        };
        const double z = map_value(mean, sigma, bound, kAbove, sigma_v);
        const double near = 1e-6 * sigma;
        EXPECT_GT(slope(z - near), 0) << sigma << " " << bound << " " << sigma_v;
        EXPECT_LT(slope(z + near), 0) << sigma << " " << bound << " " << sigma_v;
      }
}

TEST(MapValue, MovesNothingThatDoesNotConflict) {
  EXPECT_NEAR(map_value(5, 1, 0, kAbove, 1e-3), 5, 1e-9);
  EXPECT_NEAR(map_value(-5, 1, 0, kAbove, 1e-3), 0, 0.01);
}

TEST(UkfPoints, AreClipped) {
  const SigmaPoints points = ukf_points(1, 2, {0, 2.5});
  EXPECT_EQ(points.low, 0);
  EXPECT_EQ(points.high, 2.5);
  EXPECT_EQ(points.mean(), 1.25);
}

// Second moment about z* as corrected (2.55): + z*^2, not + z*.
double printed_second_moment(double a, double z, bool corrected) {
  const double c = 0.5, d = kInvSqrt2Pi, mass = normal_upper(a), e = std::exp(-c * a * a);
  const double head =
      d / mass *
      (0.25 * std::sqrt(M_PI / (c * c * c)) * (1 - std::erf(a * std::sqrt(c))) +
       a / (2 * c) * e - z / c * e);
  return head + (corrected ? z * z : z);
}

TEST(SecondMoment, IsTheThesisFormulaWithItsMisprintCorrected) {
  for (double a : {-1.0, 0.0, 1.0, 2.0}) {
    const double z = mle_value(a, kAbove, 0.1);
    const Moments got = correct_range(RangeRule::kMle, 0, 1, a, kAbove, 0.1);
    EXPECT_NEAR(got.variance / printed_second_moment(a, z, true), 1, 1e-10) << a;
    EXPECT_GT(std::abs(got.variance - printed_second_moment(a, z, false)), 0.01) << a;
  }
  // Printed values, 13 digits.
  EXPECT_NEAR(correct_range(RangeRule::kMle, 0, 1, 0, kAbove, 0.1).variance,
              0.7208461756789, 1e-12);
  EXPECT_NEAR(correct_range(RangeRule::kUkf, 0, 1, 0, kAbove, 0.1).variance,
              0.4521154391971, 1e-12);
}

TEST(CorrectRange, ApproximationsAreNeverSurerThanTheExactOne) {
  for (double bound = -6; bound < 6; bound += 0.37)
    for (Side side : {kAbove, kBelow}) {
      const Moments exact = correct_range(RangeRule::kExact, 1, 4, bound, side, 0.3);
      for (RangeRule rule : {RangeRule::kMle, RangeRule::kMap, RangeRule::kUkf}) {
        const Moments got = correct_range(rule, 1, 4, bound, side, 0.3);
        const double bias = got.mean - exact.mean;
        EXPECT_NEAR(got.variance, exact.variance + bias * bias, 1e-12 * got.variance);
      }
    }
}

TEST(CorrectRange, CountsBoundsFromThePredictedRange) {
  // The shift to a zero-mean prior is a step that the thesis leaves out.
  for (RangeRule rule : kRangeRules) {
    const Moments at_zero = correct_range(rule, 0, 4, 1, kBelow, 0.3);
    const Moments shifted = correct_range(rule, 100, 4, 101, kBelow, 0.3);
    EXPECT_NEAR(shifted.mean, 100 + at_zero.mean, 1e-12) << range_rule_name(rule);
    EXPECT_NEAR(shifted.variance, at_zero.variance, 1e-12) << range_rule_name(rule);
  }
}

// Table of the gain (A.15) with prior N(0, 1), noise-free range: what it claims and what
// the mean square error really is.
TEST(GainA15, IsOverconfident) {
  struct Row {
    Moments exact;
    double claimed, really;
  };
  const auto moments = [](double lower, double upper) {
    const TruncatedNormal cut = truncate_normal(0, 1, {lower, upper});
    return Moments{cut.mean, cut.variance};
  };
  const double inf = HUGE_VAL;
  const Row rows[] = {{moments(-inf, inf), 0.5, 1},
                      {moments(0, inf), 0.2665, 0.4086},
                      {moments(-2, inf), 0.4699, 0.8871},
                      {moments(-1, 1), 0.2255, 0.2911}};
  for (const Row& row : rows) {
    const double gain = 1 / (1 + row.exact.variance);
    const double error = (1 - gain) * row.exact.mean;
    // The table is printed with four digits.
    EXPECT_NEAR(1 - gain, row.claimed, 6e-5);
    EXPECT_NEAR(row.exact.variance + error * error, row.really, 6e-5);
    EXPECT_LT(1 - gain, row.exact.variance);
  }
  const Moments half = correct_range(RangeRule::kGainA15, 0, 1, 0, kAbove, 0.1);
  EXPECT_NEAR(half.variance, rows[1].claimed, 6e-5);
  EXPECT_NEAR(half.mean, rows[1].exact.mean / (1 + rows[1].exact.variance), 1e-14);
  const Moments nothing = correct_range(RangeRule::kGainA15, 0, 1, -40, kAbove, 0.1);
  EXPECT_NEAR(nothing.variance, 0.5, 1e-12) << "halved by a reading that says nothing";
}

}  // namespace
}  // namespace skein::model::range_rule_test
