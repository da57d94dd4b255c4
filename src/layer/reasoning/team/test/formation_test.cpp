#include <gtest/gtest.h>

#include <cmath>

#include "layer/reasoning/team/formation_control.h"
#include "layer/reasoning/team/wingman.h"

namespace skein::reasoning {
namespace {

class Plain final : public Terrain {
 public:
  double elevation_msl(const Vec2& p) const override { return p.x() > 900 ? 50 : 10; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};

NavEstimate nav(double time, const Vec3& p, const Vec3& v) {
  NavEstimate n;
  n.time = Time::from_seconds(time);
  n.p_N = p;
  n.v_N = v;
  return n;
}

TEST(Slot, MovesWithTheLeaderAndTurnsWithItsCourse) {
  const NavEstimate leader = nav(10, {100, 0, -200}, {20, 0, -1});
  const PlanPoint straight = slot_at(leader, 0, {-30, 20}, 2);
  EXPECT_EQ(straight.time, Time::from_seconds(12));
  EXPECT_LT((straight.p_N - Vec3(110, 20, -202)).norm(), 1e-9);
  EXPECT_LT((straight.v_N - leader.v_N).norm(), 1e-9);

  // A quarter turn to the right in 10 s: radius 20 / (pi/20).
  const double rate = geo::kPi / 20, radius = 20 / rate;
  const PlanPoint turned = slot_at(leader, rate, {-30, 20}, 10);
  EXPECT_NEAR(turned.p_N.x(), 100 + radius - 20, 1e-9);
  EXPECT_NEAR(turned.p_N.y(), radius - 30, 1e-9);

  // The velocity is the derivative of the position.
  const double h = 1e-5;
  const Vec3 difference = (slot_at(leader, rate, {-30, 20}, 3 + h).p_N -
                           slot_at(leader, rate, {-30, 20}, 3 - h).p_N) /
                          (2 * h);
  EXPECT_LT((difference - slot_at(leader, rate, {-30, 20}, 3).v_N).norm(), 1e-6);
}

FormationOptions three(bool direct) {
  FormationOptions options;
  options.team = {EntityId{1}, EntityId{2}, EntityId{3}};
  options.route = {{0, 0}, {1000, 0}};
  options.slots = {{-30, 30}, {-30, -30}};
  options.leaders = {{Time(), 0}, {Time::from_seconds(100), 2}};
  options.direct = direct;
  return options;
}

Message report(EntityId from, std::uint32_t task, const NavEstimate& at) {
  Message message;
  message.from = from;
  message.content = AircraftReport{at, {}, task, false};
  return message;
}

TEST(FormationControl, AppointsLeaderAndFollowersAndSwapsThem) {
  FormationControl control(three(false));
  AgentOutput out;
  AgentInput in;
  control.step(in, out);
  ASSERT_EQ(out.outbox.size(), 3u);
  EXPECT_TRUE(
      std::holds_alternative<FlyRoute>(std::get<Task>(out.outbox[0].content).what));
  EXPECT_EQ(std::get<FollowLeader>(std::get<Task>(out.outbox[2].content).what).offset,
            Vec2(-30, -30));

  out = {};
  in.now = Time::from_seconds(100);
  control.step(in, out);
  ASSERT_GE(out.outbox.size(), 3u);
  const auto& first = std::get<FollowLeader>(std::get<Task>(out.outbox[0].content).what);
  EXPECT_EQ(first.leader, EntityId{3});
  EXPECT_EQ(first.offset, Vec2(-30, 30));
  EXPECT_TRUE(
      std::holds_alternative<FlyRoute>(std::get<Task>(out.outbox[2].content).what));
  ASSERT_EQ(out.events.size(), 1u);
  EXPECT_EQ(out.events[0].kind, "leader");
}

TEST(FormationControl, PassesTheLeadersPositionOnUnlessTheLeaderDoes) {
  for (const bool direct : {false, true}) {
    FormationControl control(three(direct));
    AgentOutput out;
    control.step({}, out);
    EXPECT_EQ(std::get<FlyRoute>(std::get<Task>(out.outbox[0].content).what).tell.size(),
              direct ? 2u : 0u);
    out = {};
    const std::vector<Message> inbox = {
        report(EntityId{1}, 1, nav(1, {5, 6, -7}, {1, 0, 0})),
        report(EntityId{2}, 1, nav(1, Vec3::Zero(), Vec3::Zero())),
        report(EntityId{3}, 1, nav(1, Vec3::Zero(), Vec3::Zero())),
        report(EntityId{9}, 1, nav(1, Vec3::Zero(), Vec3::Zero()))};
    AgentInput in;
    in.now = Time::from_seconds(10);
    in.inbox = inbox;
    control.step(in, out);
    ASSERT_EQ(out.outbox.size(), direct ? 0u : 2u);
    if (!direct) {
      EXPECT_EQ(std::get<TeamPosition>(out.outbox[1].content).nav.p_N, Vec3(5, 6, -7));
    }
  }
}

TEST(FormationControl, RepeatsOrdersUntilTheyAreConfirmed) {
  FormationControl control(three(true));
  AgentOutput out;
  control.step({}, out);
  out = {};
  const std::vector<Message> inbox = {
      report(EntityId{2}, 1, nav(1, Vec3::Zero(), Vec3::Zero()))};
  AgentInput in;
  in.now = Time::from_seconds(3);
  in.inbox = inbox;
  control.step(in, out);
  ASSERT_EQ(out.outbox.size(), 2u);
  EXPECT_EQ(out.outbox[0].to, EntityId{1});
  EXPECT_EQ(out.outbox[1].to, EntityId{3});
}

class WingmanTest : public testing::Test {
 protected:
  AgentOutput step(double time, std::vector<Message> inbox) {
    const NavEstimate own = nav(time, {0, 0, -150}, {20, 0, 0});
    AgentInput in;
    in.now = Time::from_seconds(time);
    in.nav = &own;
    in.inbox = inbox;
    AgentOutput out;
    wingman.step(in, out);
    return out;
  }
  Message task(std::uint32_t number, decltype(Task::what) what) {
    Message message;
    message.content = Task{number, std::move(what)};
    return message;
  }

  Plain ground;
  Wingman wingman{WingmanOptions{}, EntityId{2}, EntityId{0}, FlightLimits{}, ground};
};

TEST_F(WingmanTest, LeadsAboveTheHighestGroundOfItsRouteAndTellsWhomItShall) {
  const AgentOutput out =
      step(0, {task(1, FlyRoute{{{0, 0}, {1000, 0}}, 3, {EntityId{5}}})});
  ASSERT_TRUE(out.command);
  const auto& way = std::get<FlyWaypoints>(out.command->guidance);
  EXPECT_EQ(way.laps, 3);
  EXPECT_EQ(way.points.at(1).altitude_msl, 50 + 120);
  ASSERT_EQ(out.outbox.size(), 2u);
  EXPECT_EQ(std::get<TeamPosition>(out.outbox[1].content).aircraft, EntityId{2});
  EXPECT_FALSE(step(0.5, {}).command) << "an order is given once";
}

TEST_F(WingmanTest, FollowsEachNewPositionOfItsLeaderAndNoOther) {
  EXPECT_TRUE(std::holds_alternative<HoldPosition>(
      step(0, {task(1, FollowLeader{EntityId{1}, {-30, 20}})}).command->guidance));
  const auto position = [](EntityId of, double time, const Vec3& v) {
    Message message;
    message.content = TeamPosition{of, nav(time, {100, 0, -200}, v)};
    return message;
  };
  EXPECT_FALSE(step(1, {position(EntityId{7}, 1, {20, 0, 0})}).command);
  const auto out = step(1.5, {position(EntityId{1}, 1, {20, 0, 0})});
  const Plan& plan = std::get<FollowPlan>(out.command->guidance).plan;
  EXPECT_LT((plan.front().p_N - Vec3(70, 20, -200)).norm(), 1e-9);
  EXPECT_EQ(plan.front().time, Time::from_seconds(1));
  EXPECT_EQ(plan.back().time, Time::from_seconds(1.5 + 8));
  EXPECT_FALSE(step(1.7, {position(EntityId{1}, 1, {0, 20, 0})}).command) << "old news";
  // Now it turns: half a radian in a second, of which it can follow a part.
  const auto turning =
      step(2, {position(EntityId{1}, 2, {20 * std::cos(0.5), 20 * std::sin(0.5), 0})});
  const Plan& bent = std::get<FollowPlan>(turning.command->guidance).plan;
  const NavEstimate now =
      nav(2, {100, 0, -200}, {20 * std::cos(0.5), 20 * std::sin(0.5), 0});
  const double rate = bearable_turn_rate(now, 0.5, {-30, 20}, FlightLimits{}, 0);
  EXPECT_LT((bent.at(1).v_N - slot_at(now, rate, {-30, 20}, 1).v_N).norm(), 1e-9);
}

TEST_F(WingmanTest, SwapsRolesAndKeepsTheNewestOrder) {
  step(0, {task(5, FollowLeader{EntityId{1}, {-30, 20}})});
  EXPECT_FALSE(step(1, {task(4, FlyRoute{{{0, 0}, {1, 1}}, 1, {}})}).command);
  EXPECT_TRUE(std::holds_alternative<FlyWaypoints>(
      step(2, {task(6, FlyRoute{{{0, 0}, {1, 1}}, 1, {}})}).command->guidance));
}

TEST_F(WingmanTest, RefusesWhatItCannotDo) {
  const AgentOutput out = step(0, {task(1, FollowEdge{})});
  EXPECT_FALSE(out.command);
  ASSERT_EQ(out.events.size(), 1u);
  EXPECT_EQ(out.events[0].kind, "task-refused");
}

TEST(Formation, ASlotTurnsNoFasterThanItsAircraftCanFly) {
  NavEstimate leader;
  leader.v_N = {25, 0, 0};
  FlightLimits limits;
  limits.airspeed = 25;
  limits.slowest = 18;
  limits.fastest = 32;
  limits.turn_radius = 100;
  const double wind = 3;
  for (const double side : {-50.0, 50.0})
    for (const double rate : {-0.3, 0.3}) {
      const Vec2 offset(-40, side);
      const double turned = bearable_turn_rate(leader, rate, offset, limits, wind);
      EXPECT_GT(turned * rate, 0);
      EXPECT_LT(std::abs(turned), std::abs(rate));
      const double speed = geo::horizontal(slot_at(leader, turned, offset, 0).v_N).x();
      EXPECT_LE(speed, limits.fastest - wind);
      EXPECT_GE(speed, limits.slowest + wind);
    }
  // A gentle turn is flown as it is.
  EXPECT_EQ(bearable_turn_rate(leader, 0.02, {-40, 20}, limits, wind), 0.02);
}

}  // namespace
}  // namespace skein::reasoning
