// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "skein/layer/environment/fire/bearing_profile.h"
#include "skein/layer/environment/fire/fuel.h"

namespace skein::environment::profile_test {
namespace {

using geo::kPi;

TEST(BearingProfile, HarmonicsReachTheirAmplitudeAndTheRmsOfAUniformSpread) {
  for (int count : {5, 8}) {
    double mean_square = 0;
    constexpr int kProfiles = 300, kBearings = 360;
    for (std::uint32_t i = 0; i < kProfiles; ++i) {
      RandomStream random(7, i, Purpose::kTest);
      const BearingProfile profile = BearingProfile::harmonics(count, 180, 1.75, random);
      double largest = 0, mean = 0;
      for (int k = 0; k < kBearings; ++k) {
        const double value = profile.at(geo::unit(2 * kPi * k / kBearings));
        largest = std::max(largest, std::abs(value));
        mean += value / kBearings;
        mean_square += value * value / (kProfiles * kBearings);
      }
      EXPECT_LE(largest, 180 * 1.001);
      EXPECT_GE(largest, 180 * 0.99);
      EXPECT_NEAR(mean, 0, 1e-9);
    }
    // Profiles differ by some 8 %: 0.5 % standard error over 300. 180 / sqrt 3 = 103.9.
    EXPECT_NEAR(std::sqrt(mean_square), 103.9, 0.03 * 103.9);
  }
}

TEST(BearingProfile, HarmonicsAreSmooth) {
  RandomStream random(1, 0, Purpose::kTest);
  const BearingProfile profile = BearingProfile::harmonics(5, 180, 1.75, random);
  for (int k = 0; k < 3600; ++k) {
    const double a = profile.at(geo::unit(2 * kPi * k / 3600));
    const double b = profile.at(geo::unit(2 * kPi * (k + 1) / 3600));
    EXPECT_LT(std::abs(a - b), 180 * 5 * 2 * kPi / 3600);  // Bernstein's inequality
  }
}

TEST(BearingProfile, SectorsAreConstantWithinAndDifferBetween) {
  RandomStream random(3, 0, Purpose::kTest);
  const BearingProfile profile = BearingProfile::sectors(60, 0.1, random);
  std::set<double> values;
  for (int k = 0; k < 60; ++k) {
    const double value = profile.at(geo::unit(geo::radians(6 * k + 0.01)));
    EXPECT_EQ(value, profile.at(geo::unit(geo::radians(6 * k + 5.99))));
    EXPECT_LE(std::abs(value), 0.1);
    values.insert(value);
  }
  EXPECT_EQ(values.size(), 60u);
}

TEST(BearingProfile, DependsOnTheSeedOnly) {
  RandomStream a(5, 0, Purpose::kFireShape), b(5, 0, Purpose::kFireShape),
      c(6, 0, Purpose::kFireShape);
  const BearingProfile pa = BearingProfile::harmonics(5, 1, 1.75, a);
  const BearingProfile pb = BearingProfile::harmonics(5, 1, 1.75, b);
  const BearingProfile pc = BearingProfile::harmonics(5, 1, 1.75, c);
  EXPECT_EQ(pa.at(geo::unit(1)), pb.at(geo::unit(1)));
  EXPECT_NE(pa.at(geo::unit(1)), pc.at(geo::unit(1)));
}

TEST(PatchyFuel, HasTheStatisticsAskedForAndIsSmooth) {
  const PatchyFuelOptions options{100, 0.4, 0};
  const PatchyFuel fuel(options, 1);
  double sum = 0, squares = 0;
  int n = 0;
  for (double x = 0; x < 6400; x += 37) {
    for (double y = 0; y < 6400; y += 37) {
      const double log_factor = std::log(fuel.factor({x, y}));
      sum += log_factor;
      squares += log_factor * log_factor;
      ++n;
      // From node to node it changes by up to 6 sd, most steeply 1.5 (and norming 2)
      // times that.
      EXPECT_LT(std::abs(std::log(fuel.factor({x + 0.1, y})) - log_factor),
                0.4 * 18 * 0.1 / 100);
    }
  }
  // 4096 independent patches: 1.6 % of the sd for the mean, 1.1 % for the sd itself.
  EXPECT_NEAR(sum / n, 0, 0.05 * 0.4);
  EXPECT_NEAR(std::sqrt(squares / n), 0.4, 0.05 * 0.4);
}

TEST(PatchyFuel, LeavesTheAskedShareBare) {
  const PatchyFuel fuel({100, 0.4, 0.15}, 2);
  int bare = 0, n = 0;
  for (double x = -3200; x < 3200; x += 23)
    for (double y = -3200; y < 3200; y += 23) {
      const double factor = fuel.factor({x, y});
      EXPECT_TRUE(std::isfinite(factor) && factor >= 0);
      bare += factor == 0;
      ++n;
    }
  EXPECT_NEAR(1.0 * bare / n, 0.15, 0.01);  // the threshold is taken from the same field
}

TEST(PatchyFuel, RefusesImpossibleOptions) {
  EXPECT_TRUE(check(PatchyFuelOptions{}).ok());
  EXPECT_FALSE(check(PatchyFuelOptions{0, 0.3, 0}).ok());
  EXPECT_FALSE(check(PatchyFuelOptions{100, 0.3, 0.9}).ok());
  EXPECT_FALSE(
      check(PatchyFuelOptions{100, std::numeric_limits<double>::quiet_NaN(), 0}).ok());
}

}  // namespace
}  // namespace skein::environment::profile_test
