// SPDX-License-Identifier: Apache-2.0
#include "skein/base/math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>

#include "skein/base/hash.h"
#include "skein/base/random.h"

namespace skein::math_test {
namespace {

using Function = double (*)(double);

struct Row {
  const char* name;
  Function ours;
  Function systems;
  double low, high;
};

const Row kRows[] = {
    {"sin", math::sin, std::sin, -1e4, 1e4},
    {"cos", math::cos, std::cos, -1e4, 1e4},
    {"tan", math::tan, std::tan, -1.5, 1.5},
    {"asin", math::asin, std::asin, -1, 1},
    {"acos", math::acos, std::acos, -1, 1},
    {"atan", math::atan, std::atan, -50, 50},
    {"sinh", math::sinh, std::sinh, -20, 20},
    {"cosh", math::cosh, std::cosh, -20, 20},
    {"tanh", math::tanh, std::tanh, -5, 5},
    {"exp", math::exp, std::exp, -700, 700},
    {"exp2", math::exp2, std::exp2, -1000, 1000},
    {"expm1", math::expm1, std::expm1, -30, 30},
    {"log", math::log, std::log, 1e-6, 1e6},
    {"log1p", math::log1p, std::log1p, -0.9, 1e3},
    {"log2", math::log2, std::log2, 1e-6, 1e6},
    {"log10", math::log10, std::log10, 1e-6, 1e6},
    {"cbrt", math::cbrt, std::cbrt, -1e3, 1e3},
    {"erf", math::erf, std::erf, -4, 4},
    {"erfc", math::erfc, std::erfc, -4, 6},
};

constexpr int kDraws = 20000;

// Two libraries, each within an ulp or so of the true value.
double allowed(double value) {
  return 4 * std::numeric_limits<double>::epsilon() * std::abs(value);
}

TEST(Math, AgreesWithTheSystemsLibraryToRounding) {
  for (const Row& row : kRows) {
    RandomStream random(7, 0, Purpose::kTest);
    for (int i = 0; i < kDraws; ++i) {
      const double x = random.uniform(row.low, row.high);
      const double expected = row.systems(x);
      ASSERT_NEAR(row.ours(x), expected, allowed(expected)) << row.name << " of " << x;
    }
  }
}

TEST(Math, AgreesInTwoVariablesToRounding) {
  RandomStream random(8, 0, Purpose::kTest);
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.uniform(-100, 100), y = random.uniform(-100, 100);
    ASSERT_NEAR(math::atan2(y, x), std::atan2(y, x), allowed(std::atan2(y, x)));
    ASSERT_NEAR(math::hypot(y, x), std::hypot(y, x), allowed(std::hypot(y, x)));
    const double base = random.uniform(0.01, 100), power = random.uniform(-20, 20);
    ASSERT_NEAR(math::pow(base, power), std::pow(base, power),
                allowed(std::pow(base, power)));
  }
}

TEST(Math, SpecialValuesAreThoseOfC) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(math::exp(-inf), 0);
  EXPECT_EQ(math::log(0), -inf);
  EXPECT_TRUE(std::isnan(math::log(-1)));
  EXPECT_TRUE(std::isnan(math::sin(inf)));
  EXPECT_EQ(math::atan2(0, -1), std::atan2(0.0, -1.0));
  EXPECT_TRUE(std::signbit(math::atan2(-0.0, 1)));
  EXPECT_EQ(math::pow(0, 0), 1);
  EXPECT_EQ(math::hypot(inf, std::nan("")), inf);
}

// The very bits, as they were found on a processor with and one without fused
// multiply-add. A processor, compiler or library that gives others breaks the promise
// that equal scenarios have equal content hashes.
TEST(Math, GivesTheSameBitsEverywhere) {
  Hasher hasher;
  RandomStream random(9, 0, Purpose::kTest);
  for (int i = 0; i < kDraws; ++i)
    for (const Row& row : kRows) {
      const double value = row.ours(random.uniform(row.low, row.high));
      hasher.add(std::as_bytes(std::span(&value, 1)));
    }
  EXPECT_EQ(hasher.hex(), "ee2cf89df059ba7382a3999309b77ae3");
}

}  // namespace
}  // namespace skein::math_test
