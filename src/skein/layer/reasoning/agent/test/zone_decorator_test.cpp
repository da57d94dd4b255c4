#include "skein/layer/reasoning/agent/zone_decorator.h"

#include <gtest/gtest.h>

#include "skein/layer/reasoning/agent/test/test_flight.h"

namespace skein::reasoning {
namespace {

// Says once which course to hold, and reports.
class Straight final : public Agent {
 public:
  void step(const AgentInput&, AgentOutput& out) override {
    if (!reported_) out.command = AutopilotCommand{HoldCourse{0}, 220, {}};
    reported_ = true;
    out.outbox.emplace_back().content = AircraftReport{};
  }

 private:
  bool reported_ = false;
};

struct Shielded {
  AgentOutput step(double time, const std::vector<Message>& inbox = {}) {
    const NavEstimate nav = aircraft.nav(Time::from_seconds(time));
    AgentInput in;
    in.now = nav.time;
    in.nav = &nav;
    in.inbox = inbox;
    in.autopilot.on_ground = on_ground;
    AgentOutput out;
    agent.step(in, out);
    if (out.command) aircraft.obey(*out.command);
    return out;
  }
  test::FlatGround ground;
  test::TestAircraft aircraft;
  bool on_ground = false;
  ZoneDecorator agent{{},     EntityId{1}, FlightLimits{},
                      ground, {},          std::make_unique<Straight>()};
};

Message zone_on(const Vec2& centre, double radius) {
  Message message;
  message.content = ZoneChange{1, true, {.area = Disc{centre, radius}, .name = "a"}};
  return message;
}

TEST(ZoneDecorator, KeepsItsPilotOutAndLetsItGoOn) {
  Shielded flight;
  flight.step(0);
  double nearest = 1e9;
  bool resumed = false;
  for (int k = 1; k <= 240; ++k) {
    std::vector<Message> inbox;
    if (k == 40) inbox.push_back(zone_on({1500, 20}, 300));
    const AgentOutput out = flight.step(0.5 * k, inbox);
    EXPECT_EQ(std::get<AircraftReport>(out.outbox.back().content).zone_changes,
              k < 40 ? 0u : 1u);
    for (int i = 0; i < 10; ++i) flight.aircraft.step(0.05);
    nearest = std::min(nearest, (flight.aircraft.position() - Vec2(1500, 20)).norm());
    resumed = flight.aircraft.position().x() > 1900;
  }
  EXPECT_GT(nearest, 300);
  EXPECT_TRUE(resumed);
  EXPECT_EQ(std::get<HoldCourse>(flight.aircraft.command.guidance).course, 0);
}

TEST(ZoneDecorator, DoesNotTakeOffIntoAZone) {
  Shielded flight;
  flight.on_ground = true;
  EXPECT_FALSE(flight.step(0, {zone_on({0, 0}, 300)}).command);
  EXPECT_FALSE(flight.step(0.5).command);
  Message off;
  off.content = ZoneChange{2, false, {.name = "a"}};
  EXPECT_TRUE(flight.step(1, {off}).command);
}

}  // namespace
}  // namespace skein::reasoning
