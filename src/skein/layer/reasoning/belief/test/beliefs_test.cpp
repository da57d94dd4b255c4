// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/belief/beliefs.h"

#include <gtest/gtest.h>

#include "skein/base/random.h"

namespace skein::reasoning::beliefs_test {
namespace {

Time at(double seconds) {
  return Time::from_seconds(seconds);
}

TEST(ObjectMemory, FindsHowAnObjectMovesAndGoesOnWithIt) {
  ObjectMemory memory;
  RandomStream random(1, 2, Purpose::kCamera, 0);
  const Vec2 start(100, -50), velocity(1.2, -0.7);
  for (int k = 0; k < 60; ++k) {
    const double north = random.normal(), east = random.normal();
    memory.add({7, at(k), start + k * velocity + 2 * Vec2(north, east), 2});
  }
  const auto belief = memory.find(7);
  ASSERT_TRUE(belief);
  // Errors of a steady track: three standard deviations.
  EXPECT_LT((belief->velocity - velocity).norm(), 3 * 1.42 * belief->velocity_sd);
  EXPECT_LT((belief->at(at(64)) - (start + 64 * velocity)).norm(), 10);
  EXPECT_LT(belief->position_sd, 2);
  EXPECT_FALSE(memory.find(8));
}

TEST(ObjectMemory, LeavesOutOldSightingsAndForgetsWhatIsTooOld) {
  ObjectMemory memory;
  memory.add({1, at(100), {10, 0}, 1});
  memory.add({1, at(50), {500, 0}, 1});
  EXPECT_EQ(memory.find(1)->position, Vec2(10, 0));
  memory.forget(at(650));
  EXPECT_TRUE(memory.find(1));
  memory.forget(at(701));
  EXPECT_FALSE(memory.find(1));
}

TEST(Beliefs, PlaceWhatTheCameraSeesAndTellTheStationOnceASecond) {
  Beliefs beliefs(EntityId{9});
  NavEstimate nav;
  nav.p_N = {100, 200, -50};
  nav.v_N = {20, 0, 0};
  int told = 0;
  for (int k = 0; k < 10; ++k) {
    nav.time = at(0.5 * k);
    nav.p_N.x() = 100 + 20 * nav.time.seconds();
    // The picture was taken half a second ago, of an object that stands at (150, 210).
    const double then = nav.p_N.x() - 10;
    const std::vector<SensorSample> samples{
        DetectionSample{nav.time - at(0.5), 3, {150 - then, 10}, 1}};
    AgentInput in;
    in.now = nav.time;
    in.nav = &nav;
    in.samples = samples;
    AgentOutput out;
    beliefs.step(in, out);
    for (const Message& message : out.outbox) {
      EXPECT_EQ(message.to, EntityId{9});
      const auto& sighting = std::get<ObjectSighting>(message.content);
      EXPECT_LT((sighting.position - Vec2(150, 210)).norm(), 1e-9);
      ++told;
    }
  }
  EXPECT_EQ(told, 5);
  ASSERT_TRUE(beliefs.objects().find(3));
  EXPECT_LT((beliefs.objects().find(3)->position - Vec2(150, 210)).norm(), 1e-6);
}

TEST(Beliefs, KeepTheNewestOfTheTeamHoweverItArrives) {
  Beliefs beliefs(EntityId{9});
  const auto receive = [&](double time, double north) {
    Message message;
    message.from = EntityId{9};
    NavEstimate nav;
    nav.time = at(time);
    nav.p_N.x() = north;
    message.content = TeamPosition{EntityId{4}, nav};
    const std::vector<Message> inbox{message};
    AgentInput in;
    in.inbox = inbox;
    AgentOutput out;
    beliefs.step(in, out);
  };
  receive(10, 1);
  receive(5, 2);
  ASSERT_TRUE(beliefs.team().find(EntityId{4}));
  EXPECT_EQ(beliefs.team().find(EntityId{4})->p_N.x(), 1);
  receive(11, 3);
  EXPECT_EQ(beliefs.team().find(EntityId{4})->p_N.x(), 3);
}

}  // namespace
}  // namespace skein::reasoning::beliefs_test
