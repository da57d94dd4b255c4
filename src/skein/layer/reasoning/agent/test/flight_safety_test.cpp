// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/flight_safety.h"

#include <gtest/gtest.h>

#include "skein/layer/reasoning/trajectory/steering_flight.h"
#include "skein/layer/reasoning/trajectory/test/test_flight.h"

namespace skein::reasoning::flight_safety_test {
namespace {

// Flies north whatever comes.
struct Straight {
  AgentOutput step(double time, const std::vector<Message>& inbox = {}) {
    const NavEstimate nav = aircraft.nav(Time::from_seconds(time));
    AgentInput in;
    in.now = nav.time;
    in.nav = &nav;
    in.inbox = inbox;
    in.autopilot.on_ground = on_ground;
    AgentOutput out;
    safety.listen(in, out);
    if (safety.may_fly(in, 220, false, out)) {
      Steering north;
      north.altitude_msl = 220;
      steer(north, context,
            {in, safety.zones(), safety.returns(), safety.off_plan(), safety.news()},
            out);
    }
    safety.finish(in, out);
    if (out.command) aircraft.obey(*out.command);
    return out;
  }
  test::FlatGround ground;
  test::TestAircraft aircraft;
  bool on_ground = false;
  FlightContext context{EntityId{1}, FlightLimits{}, &ground, nullptr, 120};
  FlightSafety safety{{}, {}, EntityId{1}, FlightLimits{}, ground, {}};
};

Message zone_on(const Vec2& centre, double radius) {
  Message message;
  message.content = ZoneChange{1, true, {.area = Disc{centre, radius}, .name = "a"}};
  return message;
}

TEST(FlightSafety, KeepsATaskOutOfZonesAndLetsItGoOn) {
  Straight flight;
  flight.step(0);
  double nearest = 1e9;
  bool resumed = false;
  for (int k = 1; k <= 240; ++k) {
    std::vector<Message> inbox;
    if (k == 40) inbox.push_back(zone_on({1500, 20}, 300));
    flight.step(0.5 * k, inbox);
    EXPECT_EQ(flight.safety.zones().changes_known(), k < 40 ? 0u : 1u);
    for (int i = 0; i < 10; ++i) flight.aircraft.step(0.05);
    nearest = std::min(nearest, (flight.aircraft.position() - Vec2(1500, 20)).norm());
    resumed = flight.aircraft.position().x() > 1900;
  }
  EXPECT_GT(nearest, 300);
  EXPECT_TRUE(resumed);
  EXPECT_EQ(std::get<HoldCourse>(flight.aircraft.command.guidance).course, 0);
}

TEST(FlightSafety, DoesNotTakeOffIntoAZone) {
  Straight flight;
  flight.on_ground = true;
  EXPECT_FALSE(flight.step(0, {zone_on({0, 0}, 300)}).command);
  EXPECT_FALSE(flight.step(6).command);
  Message off;
  off.content = ZoneChange{2, false, {.name = "a"}};
  EXPECT_FALSE(flight.step(7, {off}).command);  // it rests before it takes off
  EXPECT_TRUE(flight.step(12.5).command);
}

}  // namespace
}  // namespace skein::reasoning::flight_safety_test
