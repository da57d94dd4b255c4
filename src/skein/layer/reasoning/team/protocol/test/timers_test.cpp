// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/timers.h"

#include <gtest/gtest.h>

#include "skein/base/random.h"

namespace skein::reasoning::timers_test {
namespace {

TEST(TeamTimers, WaitLongerTheMoreIsLost) {
  EXPECT_EQ(time_until_lost({}, 0), 4);
  EXPECT_EQ(time_until_lost({}, 0.05), 4);
  EXPECT_EQ(time_until_lost({}, 0.1), 4);
  EXPECT_EQ(time_until_lost({}, 0.3), 8);
  EXPECT_EQ(time_until_lost({}, 0.5), 14);
  EXPECT_EQ(time_until_lost({}, 0.9), 88);
  EXPECT_EQ(time_until_lost({}, 1), 88);
}

TEST(TeamTimers, WaitLongerWhereTheMissionIsLargerThanTheRadioReaches) {
  EXPECT_EQ(time_until_lost({2, 3000, 1500, 0.1}, 0.1), 16);
  EXPECT_EQ(time_until_lost({2, 500, 1500, 0.1}, 0.1), 8);
}

TEST(TeamTimers, FollowersOfALargeTeamSayMoreRarelyThatTheyAreThere) {
  EXPECT_EQ(follower_period({}, 1), 1);
  EXPECT_EQ(follower_period({}, 12), 1);
  EXPECT_EQ(follower_period({}, 36), 3);
  EXPECT_EQ(follower_period({}, 1000), 5);
  // Where queries are rare already they hold back no further.
  EXPECT_EQ(follower_period({20, 1, 1, 0.1}, 1000), 20);
  EXPECT_EQ(follower_period({0.5, 1, 1, 0.1}, 1000), 2.5);
}

TEST(TeamTimers, MeasureTheLoss) {
  for (const double loss : {0.0, 0.1, 0.3, 0.6}) {
    LossMeter meter;
    RandomStream random(1, 2, Purpose::kTest);
    std::uint32_t missing = 0;
    for (int k = 0; k < 2000; ++k) {
      if (random.uniform() < loss) {
        ++missing;
        continue;
      }
      meter.arrived(missing);
      missing = 0;
    }
    // Of the last 200: four standard deviations.
    EXPECT_NEAR(meter.loss(), std::max(0.05, loss), 0.15) << loss;
  }
}

}  // namespace
}  // namespace skein::reasoning::timers_test
