#include "skein/layer/reasoning/agent/launch.h"

#include <gtest/gtest.h>

namespace skein::reasoning {
namespace {

struct Told {
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
  Told told;
  EXPECT_TRUE(told.at(0, true, false));
  EXPECT_FALSE(told.out.command) << "first it rests";
  EXPECT_TRUE(told.at(5, true, false));
  ASSERT_TRUE(told.out.command);
  EXPECT_EQ(std::get<TakeOff>(told.out.command->guidance).course, 1);
  EXPECT_EQ(told.out.command->altitude_msl, 80);
  EXPECT_TRUE(told.at(6, true, true)) << "done, but on the ground: of before";
  EXPECT_FALSE(told.out.command);
  EXPECT_TRUE(told.at(9, false, false));
  EXPECT_FALSE(told.at(30, false, true));
  EXPECT_FALSE(told.at(99, true, false)) << "a landing is no new start";
}

TEST(Launch, IsOverAtTheAltitudeWhateverTheAutopilotSaysOfIt) {
  Told told;
  told.at(0, true, false);
  told.nav.p_N.z() = -60;
  EXPECT_TRUE(told.at(20, false, false));
  told.nav.p_N.z() = -75;
  EXPECT_FALSE(told.at(25, false, false));
}

TEST(Launch, IsOrderedAgainWhileTheAircraftStands) {
  Told told;
  told.at(0, true, false);
  told.at(5, true, false);
  EXPECT_TRUE(told.out.command);
  EXPECT_TRUE(told.at(24, true, false));
  EXPECT_FALSE(told.out.command);
  EXPECT_TRUE(told.at(25, true, false));
  EXPECT_TRUE(told.out.command);
}

TEST(Launch, InTheAirHasNothingToDo) {
  Told told;
  EXPECT_FALSE(told.at(0, false, false));
  EXPECT_FALSE(told.out.command);
}

}  // namespace
}  // namespace skein::reasoning
