// SPDX-License-Identifier: Apache-2.0
#include "skein/base/outages.h"

#include <gtest/gtest.h>

namespace skein::outages_test {
namespace {

Time ms(std::int64_t milliseconds) {
  return Time::from_ns(milliseconds * 1'000'000);
}

TEST(Outages, RandomOnesHaveTheirRateAndDuration) {
  Outages outages({.per_hour = 60, .mean_duration = 20},
                  RandomStream(1, 0, Purpose::kTest));
  int out = 0, begun = 0;
  bool before = false;
  const int n = 2'000'000;  // s/10
  for (int i = 0; i < n; ++i) {
    const bool now = outages.until(ms(100LL * i)).has_value();
    out += now ? 1 : 0;
    begun += now && !before ? 1 : 0;
    before = now;
  }
  // Cycles of 60 s working + 20 s out: 2,500 in all; share and number within 4.5
  // standard errors (of a cycle's length: 63/80; of the share about 0.8/sqrt(2,500)/4).
  EXPECT_NEAR(begun, 2500, 4.5 * 50 * 63 / 80);
  EXPECT_NEAR(double(out) / n, 0.25, 0.025);
}

TEST(Outages, TheirTimesDoNotDependOnWhenTheyAreAskedFor) {
  const OutageOptions options{.per_hour = 100, .mean_duration = 30};
  Outages often(options, RandomStream(2, 0, Purpose::kTest));
  Outages seldom(options, RandomStream(2, 0, Purpose::kTest));
  for (int i = 0; i < 100000; ++i) {
    const auto a = often.until(ms(100LL * i));
    if (i % 37 != 0) continue;
    EXPECT_EQ(a, seldom.until(ms(100LL * i)));
  }
}

}  // namespace
}  // namespace skein::outages_test
