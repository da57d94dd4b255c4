// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/station/heartbeat.h"

#include <gtest/gtest.h>

namespace skein::reasoning::heartbeat_test {
namespace {

TEST(HeartbeatSender, ReachesEachAircraftOncePerPeriodHoweverLongTheSteps) {
  HeartbeatSender station({EntityId{1}, EntityId{2}}, Time::from_seconds(1));
  AgentOutput out;
  for (int k = 0; k <= 40; ++k) {
    station.step(Time::from_seconds(0.25 * k), out);
  }
  ASSERT_EQ(out.outbox.size(), 2u * 11);
  EXPECT_EQ(out.outbox[0].to, EntityId{1});
  EXPECT_EQ(out.outbox[1].to, EntityId{2});
  EXPECT_TRUE(std::holds_alternative<Heartbeat>(out.outbox[0].content));

  out.outbox.clear();
  for (int k = 0; k < 5; ++k) {
    station.step(Time::from_seconds(20 + 3 * k), out);  // longer than the period
  }
  EXPECT_EQ(out.outbox.size(), 2u * 5);
}

}  // namespace
}  // namespace skein::reasoning::heartbeat_test
