// SPDX-License-Identifier: Apache-2.0
#include "skein/base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace skein::random_test {
namespace {

constexpr int kCount = 1 << 20;

std::vector<double> fast_normals(std::uint64_t seed) {
  FastNormals normal(RandomStream(seed, 0, Purpose::kTest));
  std::vector<double> all(kCount);
  for (double& x : all) x = normal();
  return all;
}

TEST(FastNormals, AreTheFormulaOfTheirBits) {
  RandomStream raw(3, 2, Purpose::kTest), fast(3, 2, Purpose::kTest);
  for (int i = 0; i < 20000; ++i) {
    const auto normals = fast.normals4();
    for (std::size_t pair = 0; pair < 2; ++pair) {
      const std::uint64_t bits = raw.bits();
      const auto low = static_cast<std::uint32_t>(bits);
      const auto high = static_cast<std::uint32_t>(bits >> 32);
      const double radius = std::sqrt(-2 * std::log((low + 0.5) / 0x1p32));
      const double turn = ((high >> 1) + 0.5) / 0x1p31 - 0.5 + (high & 1);
      const double angle = std::numbers::pi * turn;
      // The series end 2e-11 from the logarithm: up to 1e-10 where the radius is small.
      EXPECT_NEAR(normals[2 * pair], radius * std::cos(angle), 2e-10);
      EXPECT_NEAR(normals[2 * pair + 1], radius * std::sin(angle), 2e-10);
    }
  }
}

TEST(FastNormals, HaveTheNormalDistribution) {
  std::vector<double> x = fast_normals(1);
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0;
  for (const double v : x) {
    m1 += v / kCount;
    m2 += v * v / kCount;
    m3 += v * v * v / kCount;
    m4 += v * v * v * v / kCount;
  }
  // Standard errors of the k-th moment: sqrt(1, 2, 15, 96 over n); bounds at 4.5 of them.
  const double root_n = std::sqrt(kCount);
  EXPECT_NEAR(m1, 0, 4.5 * 1 / root_n);
  EXPECT_NEAR(m2, 1, 4.5 * std::sqrt(2) / root_n);
  EXPECT_NEAR(m3, 0, 4.5 * std::sqrt(15) / root_n);
  EXPECT_NEAR(m4, 3, 4.5 * std::sqrt(96) / root_n);

  // Kolmogorov-Smirnov: sqrt(n) D is above 2.0 with probability 0.0007.
  std::sort(x.begin(), x.end());
  double gap = 0;
  for (int i = 0; i < kCount; ++i) {
    const double cdf =
        std::erfc(-x[static_cast<std::size_t>(i)] / std::numbers::sqrt2) / 2;
    gap = std::max({gap, cdf - double(i) / kCount, double(i + 1) / kCount - cdf});
  }
  EXPECT_LT(root_n * gap, 2.0);

  // Counts beyond 3, 4 and 4.5: Poisson, bounds at 4.5 standard deviations (and one).
  for (const double limit : {3.0, 4.0, 4.5}) {
    const double expected = kCount * std::erfc(limit / std::numbers::sqrt2);
    const auto beyond =
        std::count_if(x.begin(), x.end(), [&](double v) { return std::abs(v) > limit; });
    EXPECT_NEAR(double(beyond), expected, 4.5 * std::sqrt(expected) + 1) << limit;
  }
}

TEST(FastNormals, AreIndependentOfTheirNeighbours) {
  const std::vector<double> x = fast_normals(2);
  // Lags within a block and beyond; squares too, since a Box-Muller pair shares a radius.
  for (std::size_t lag = 1; lag <= 9; ++lag) {
    double plain = 0, squares = 0;
    for (std::size_t i = lag; i < x.size(); ++i) {
      plain += x[i] * x[i - lag] / kCount;
      squares += (x[i] * x[i] - 1) * (x[i - lag] * x[i - lag] - 1) / kCount;
    }
    // Standard errors 1 and 2 over sqrt(n); 4.5 of them.
    EXPECT_NEAR(plain, 0, 4.5 / std::sqrt(kCount)) << lag;
    EXPECT_NEAR(squares, 0, 9 / std::sqrt(kCount)) << lag;
  }
  // All eight octants of successive triples fill evenly: chi-square of 7 degrees, above
  // 30 with probability 1e-4.
  std::vector<int> octant(8);
  for (std::size_t i = 0; i + 2 < x.size(); i += 3)
    ++octant[(x[i] > 0 ? 1U : 0U) + (x[i + 1] > 0 ? 2U : 0U) + (x[i + 2] > 0 ? 4U : 0U)];
  const double each = double(kCount / 3) / 8;
  double chi2 = 0;
  for (const int count : octant) chi2 += (count - each) * (count - each) / each;
  EXPECT_LT(chi2, 30);
}

// As GCC and Clang make them, with and without optimisation, vector and fused
// instructions.
TEST(FastNormals, AreTheSameBitsOnEveryMachine) {
  RandomStream stream(2018, 7, Purpose::kTest, 3);
  const std::array<double, 4> expected{-0x1.140a1f6e376d1p+1, 0x1.c6b08ec6d67a1p+0,
                                       -0x1.7a29f6b1f77c6p-1, -0x1.24cc5d78b0f2cp+0};
  EXPECT_EQ(stream.normals4(), expected);
}

TEST(FastNormals, LeaveTheRestOfAStartedBlockAlone) {
  RandomStream plain(5, 1, Purpose::kTest), mixed(5, 1, Purpose::kTest);
  const std::uint64_t first = plain.bits(), second = plain.bits();
  EXPECT_EQ(mixed.bits(), first);
  mixed.normals4();
  EXPECT_EQ(mixed.bits(), second);
}

}  // namespace
}  // namespace skein::random_test
