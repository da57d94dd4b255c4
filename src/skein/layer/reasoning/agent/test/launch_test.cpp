// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/launch.h"

#include <gtest/gtest.h>

namespace skein::reasoning::launch_test {
namespace {

struct Harness {
  bool at(double time, bool on_ground, bool done) {
    AgentInput in;
    in.now = Time::from_seconds(time);
    nav.heading = 1;
    in.nav = &nav;
    in.autopilot.on_ground = on_ground;
    in.autopilot.done = done;
    out = {};
    return launch.takes_off(in, 80, out);
  }
  Launch launch;
  NavEstimate nav;
  AgentOutput out;
};

TEST(Launch, FromTheGroundTakesOffAndIsOverAtTheAltitude) {
  Harness harness;
  EXPECT_TRUE(harness.at(0, true, false));
  EXPECT_FALSE(harness.out.command) << "first it rests";
  EXPECT_TRUE(harness.at(5, true, false));
  ASSERT_TRUE(harness.out.command);
  EXPECT_EQ(std::get<TakeOff>(harness.out.command->guidance).course, 1);
  EXPECT_EQ(harness.out.command->altitude_msl, 80);
  EXPECT_TRUE(harness.at(6, true, true)) << "done, but on the ground: of before";
  EXPECT_FALSE(harness.out.command);
  EXPECT_TRUE(harness.at(9, false, false));
  EXPECT_FALSE(harness.at(30, false, true));
  EXPECT_FALSE(harness.at(99, true, false)) << "a landing is no new start";
}

TEST(Launch, IsOverAtTheAltitudeWhateverTheAutopilotSaysOfIt) {
  Harness harness;
  harness.at(0, true, false);
  harness.nav.p_N.z() = -60;
  EXPECT_TRUE(harness.at(20, false, false));
  harness.nav.p_N.z() = -75;
  EXPECT_FALSE(harness.at(25, false, false));
}

TEST(Launch, IsOrderedAgainWhileTheAircraftStands) {
  Harness harness;
  harness.at(0, true, false);
  harness.at(5, true, false);
  EXPECT_TRUE(harness.out.command);
  EXPECT_TRUE(harness.at(24, true, false));
  EXPECT_FALSE(harness.out.command);
  EXPECT_TRUE(harness.at(25, true, false));
  EXPECT_TRUE(harness.out.command);
}

TEST(Launch, InTheAirHasNothingToDo) {
  Harness harness;
  EXPECT_FALSE(harness.at(0, false, false));
  EXPECT_FALSE(harness.out.command);
}

}  // namespace
}  // namespace skein::reasoning::launch_test
