// SPDX-License-Identifier: Apache-2.0
#include "skein/model/probability/error_rate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/base/random.h"

namespace skein::model::error_rate_test {
namespace {

TEST(ErrorRate, IsWhatWasStatedBeforeAnyTrial) {
  EXPECT_DOUBLE_EQ(ErrorRate(0.001).mean(), 0.001);
  EXPECT_DOUBLE_EQ(ErrorRate(0.3).mean(), 0.3);
}

TEST(ErrorRate, LearnsTheRateOfItsTrials) {
  for (const double truth : {0.0, 0.003, 0.02, 0.2}) {
    ErrorRate rate(0.001);
    RandomStream random(7, 0, Purpose::kEnsemble);
    for (int i = 0; i < 20000; ++i) rate.count(random.uniform() < truth);
    // Four standard deviations of the count, and what the first belief is worth.
    EXPECT_NEAR(rate.mean(), truth, 4 * std::sqrt(truth / 20000) + 0.0005) << truth;
  }
}

TEST(ErrorRate, NoErrorsAtAllIsKept) {
  ErrorRate rate(0);
  rate.count(true);
  EXPECT_EQ(rate.mean(), 0);
}

}  // namespace
}  // namespace skein::model::error_rate_test
