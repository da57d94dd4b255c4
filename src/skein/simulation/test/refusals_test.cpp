// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/refusals.h"

#include <gtest/gtest.h>

namespace skein::simulation::refusals_test {
namespace {

TEST(Refusals, AreReportedAtOnceThenOnceAMinuteWithTheirNumber) {
  Refusals refusals;
  const auto at = [&](double s, std::string_view why, int count = 1) {
    return refusals.report(Time::from_seconds(s), count, why);
  };
  EXPECT_EQ(at(1, "needs 32.1 m/s"), "needs 32.1 m/s");
  for (int s = 2; s <= 60; ++s) EXPECT_FALSE(at(s, "needs 31.9 m/s")) << s;
  EXPECT_EQ(at(61, "needs -3 m/s"), "needs -3 m/s (and 59 times before)");
  EXPECT_FALSE(at(120.9, "needs 4 m/s", 3));
  EXPECT_EQ(at(121, "needs 5 m/s", 2), "needs 5 m/s (and 4 times before)");
}

TEST(Refusals, OtherReasonsAreReportedBesides) {
  Refusals refusals;
  EXPECT_TRUE(refusals.report(Time::from_seconds(1), 1, "too fast"));
  EXPECT_TRUE(refusals.report(Time::from_seconds(2), 1, "too steep"));
  EXPECT_FALSE(refusals.report(Time::from_seconds(3), 1, "too fast"));
}

}  // namespace
}  // namespace skein::simulation::refusals_test
