// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/joint/step_likelihood.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "skein/base/random.h"
#include "skein/model/probability/truncated_normal.h"

namespace skein::perimeter::step_likelihood_test {
namespace {

TEST(StepLikelihood, MatchesSampling) {
  const double mean = 3, sd = 2;
  const StepLikelihood readings[] = {
      {4, 4, 0.9, 0, 0.1}, {1, 1, 0, 0, 1}, {2, 5, 0.05, 0.8, 0.15}, {5, 7, 0, 1, 0}};
  for (const StepLikelihood& reading : readings) {
    RandomStream random(7, 0, Purpose::kTest);
    double total = 0, first = 0, second = 0;
    const int samples = 400000;
    for (int i = 0; i < samples; ++i) {
      const double z = mean + sd * random.normal();
      const double w = z < reading.low
                           ? reading.below
                           : (z < reading.high ? reading.between : reading.above);
      total += w;
      first += w * z;
      second += w * z * z;
    }
    const StepMoments after = condition(mean, sd * sd, reading);
    // Four standard errors of the sample mean and variance; at least 40,000 of the
    // samples count.
    EXPECT_NEAR(after.evidence, total / samples, 4 * 0.5 / std::sqrt(samples));
    EXPECT_NEAR(after.mean, first / total, 4 * sd / std::sqrt(0.1 * samples));
    const double variance = second / total - std::pow(first / total, 2);
    EXPECT_NEAR(after.variance, variance, 4 * 2 * sd * sd / std::sqrt(0.1 * samples));
  }
}

TEST(StepLikelihood, HalfSpaceEqualsTheClosedForm) {
  for (const double bound : {-30.0, -3.0, 0.0, 2.0, 25.0}) {
    const auto exact = model::truncate_one_sided(1, 2, bound, model::Side::kAbove);
    const StepMoments after = condition(1, 4, {bound, bound, 0, 0, 1});
    // Two routes to the same number, a few roundings apart.
    EXPECT_NEAR(after.mean, exact.mean, 1e-9 * (1 + std::abs(bound)));
    EXPECT_NEAR(after.variance, exact.variance, 1e-9);
  }
}

TEST(StepLikelihood, KeepsAllButImpossibleReadingsFinite) {
  const StepMoments after = condition(0, 1, {200, 201, 0, 1, 0});
  EXPECT_EQ(after.evidence, 0);            // below the smallest double
  EXPECT_NEAR(after.mean, 200.005, 1e-3);  // 1/alpha beyond the edge
  EXPECT_GT(after.variance, 0);
  EXPECT_LT(after.variance, 1e-4);
}

TEST(StepLikelihood, AFalseReadingRateKeepsAnImpossibleReadingFromMovingTheBelief) {
  const StepMoments after = condition(0, 1, {8, 8, 1e-3, 0, 1 - 1e-3});
  // P(z > 8) = 6e-16: a thousandth of nothing.
  EXPECT_NEAR(after.mean, 0, 1e-11);
  EXPECT_NEAR(after.variance, 1, 1e-10);
  EXPECT_NEAR(after.evidence, 1e-3, 1e-12);
}

}  // namespace
}  // namespace skein::perimeter::step_likelihood_test
