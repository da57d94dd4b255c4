// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/commanded/commanded_agent.h"

#include <gtest/gtest.h>

#include "skein/base/math.h"

namespace skein::reasoning::commanded_agent_test {
namespace {

class Plain : public Terrain {
 public:
  double elevation_msl(const Vec2&) const override { return 12; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};

// An agent, and what its vehicle says.
struct Flight {
  explicit Flight(bool hovers) {
    limits.slowest = hovers ? 0 : 12;
    agent = std::make_unique<CommandedAgent>(CommandedAgentOptions{}, EntityId{1}, limits,
                                             std::make_shared<Plain>());
    nav.p_N = {0, 0, -100};
    nav.v_N = {15, 0, 0};
  }
  std::optional<AutopilotCommand> step(std::vector<VehicleRequest> requests = {}) {
    std::vector<Command> commands;
    for (VehicleRequest& request : requests)
      commands.emplace_back(VehicleCommand{"a", std::move(request)});
    AgentInput in;
    in.now = now;
    nav.time = now;
    in.nav = &nav;
    in.autopilot = status;
    in.commands = commands;
    out = {};
    agent->step(in, out);
    now = now + Time::from_seconds(0.1);
    return out.command;
  }
  FlightLimits limits;
  std::unique_ptr<CommandedAgent> agent;
  NavEstimate nav;
  AutopilotStatus status;
  AgentOutput out;
  Time now;
};

template <class T>
const T* guidance(const std::optional<AutopilotCommand>& command) {
  return command ? std::get_if<T>(&command->guidance) : nullptr;
}

TEST(CommandedAgent, BanksAsToldAndHoldsItsPlaceWhenSetpointsEnd) {
  Flight flight(false);
  const auto banked = flight.step({BankSetpoint{0.3, 120, 1, 16}});
  ASSERT_TRUE(guidance<HoldBank>(banked));
  EXPECT_EQ(guidance<HoldBank>(banked)->roll, 0.3);
  EXPECT_EQ(banked->altitude_msl, 120);
  EXPECT_EQ(banked->airspeed, 16);
  int steps = 0;
  std::optional<AutopilotCommand> next;
  while (!next && steps < 100) {
    next = flight.step();
    ++steps;
  }
  EXPECT_TRUE(guidance<HoldPosition>(next));
  EXPECT_NEAR(steps * 0.1, 3, 0.2);
  ASSERT_EQ(flight.out.events.size(), 1u);
  EXPECT_EQ(flight.out.events[0].kind, EventKind::kSetpointsEnded);
}

// The line that a wing is given passes through the setpoint, in its direction, with the
// curvature of its acceleration.
TEST(CommandedAgent, FliesTheLineThroughATrackSetpoint) {
  for (const double a : {0.0, 2.0, -3.0}) {
    Flight flight(false);
    TrackSetpoint setpoint;
    setpoint.p_N = {200, 50, -130};
    setpoint.v_N = {0, 20, 0};
    setpoint.a_N = {-a, 0, 0};  // to the right of east is south
    const auto command = flight.step({setpoint});
    const auto* path = guidance<FollowPath>(command);
    ASSERT_TRUE(path);
    ASSERT_EQ(path->path.size(), 1u);
    const PathElement& line = path->path[0];
    EXPECT_NEAR(line.curvature, a / 400, 1e-12);
    EXPECT_EQ(command->altitude_msl, 130);
    // Two seconds along it is the setpoint.
    const double angle = line.curvature * 40;
    const double chord = angle == 0 ? 40 : 2 * math::sin(angle / 2) / line.curvature;
    const Vec2 there = line.start + chord * geo::unit(line.course + angle / 2);
    EXPECT_LT((there - Vec2(200, 50)).norm(), 1e-9);
    EXPECT_NEAR(geo::wrap_pi(line.course + angle - geo::kPi / 2), 0, 1e-9);
  }
}

TEST(CommandedAgent, MovesAReferenceForWhatHovers) {
  Flight flight(true);
  TrackSetpoint setpoint;
  setpoint.p_N = {5, 0, -20};
  setpoint.v_N = {3, 0, -1};
  setpoint.a_N = {0, 2, 0};
  const auto command = flight.step({setpoint});
  const auto* plan = guidance<FollowPlan>(command);
  ASSERT_TRUE(plan);
  ASSERT_EQ(plan->plan.size(), 2u);
  EXPECT_EQ(plan->plan[0].p_N, setpoint.p_N);
  EXPECT_LT((plan->plan[1].p_N - Vec3(8, 1, -21)).norm(), 1e-9);
  EXPECT_LT((plan->plan[1].v_N - Vec3(3, 2, -1)).norm(), 1e-9);
}

MissionItem item(MissionItem::Kind kind, Vec3 p_N = Vec3::Zero()) {
  MissionItem item;
  item.kind = kind;
  item.p_N = p_N;
  return item;
}

TEST(CommandedAgent, FliesAMissionToItsEnd) {
  using Kind = MissionItem::Kind;
  Flight flight(false);
  flight.status.on_ground = true;
  flight.nav.p_N.z() = -12;
  MissionItem jump = item(Kind::kJump);
  jump.to = 1;
  jump.repeats = 1;
  MissionItem hold = item(Kind::kHold, {400, 0, -90});
  hold.hold = 2;
  const MissionUpload upload{
      {item(Kind::kTakeOff, {0, 0, -60}), item(Kind::kWaypoint, {300, 0, -80}),
       item(Kind::kWaypoint, {600, 0, -80}), jump, hold, item(Kind::kLand, {0, 0, -12})}};
  EXPECT_FALSE(flight.step({upload}));
  const auto up = flight.step({MissionStart{0}});
  ASSERT_TRUE(guidance<TakeOff>(up));
  EXPECT_EQ(up->altitude_msl, 60);

  const auto arrive = [&](const Vec3& place) {
    flight.nav.p_N = place;
    return flight.step();
  };
  flight.status.on_ground = false;
  const auto route = arrive({0, 0, -58});
  ASSERT_TRUE(guidance<FlyWaypoints>(route));
  EXPECT_EQ(guidance<FlyWaypoints>(route)->points.size(), 2u);
  EXPECT_FALSE(arrive({300, 0, -80}));  // the route goes on
  // The jump leads back to the first waypoint, once.
  EXPECT_TRUE(guidance<FlyWaypoints>(arrive({600, 0, -80})));
  EXPECT_FALSE(arrive({300, 0, -80}));
  EXPECT_TRUE(guidance<HoldPosition>(arrive({600, 0, -80})));
  EXPECT_FALSE(arrive({400, 0, -90}));
  std::optional<AutopilotCommand> next;
  for (int k = 0; k < 30 && !next; ++k) next = flight.step();
  ASSERT_TRUE(guidance<Land>(next));
  EXPECT_EQ(guidance<Land>(next)->ground_msl, 12);
  flight.status.on_ground = true;
  flight.step();
  ASSERT_FALSE(flight.out.records.empty());
  EXPECT_TRUE(std::get<MissionProgress>(flight.out.records.back()).finished);
}

TEST(CommandedAgent, LandsWhereItTookOffWithoutAPlace) {
  Flight flight(false);
  flight.step();
  flight.nav.p_N = {900, 0, -100};
  const auto landing = flight.step({LandRequest{}});
  ASSERT_TRUE(guidance<Land>(landing));
  EXPECT_EQ(guidance<Land>(landing)->point, Vec2(0, 0));
  EXPECT_EQ(guidance<Land>(landing)->ground_msl, 12);
}

}  // namespace
}  // namespace skein::reasoning::commanded_agent_test
