// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "skein/layer/reasoning/agent/onboard_agent.h"
#include "skein/layer/reasoning/mission/formation/formation_control.h"
#include "skein/layer/reasoning/task/follow/follow_task.h"
#include "skein/layer/reasoning/task/route/route_task.h"

namespace skein::reasoning::formation_test {
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
  message.content = AircraftReport{at, FlightLimits(), task};
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
  EXPECT_EQ(out.events[0].kind, EventKind::kLeader);
}

TEST(FormationControl, RepeatsOrdersUntilTheyAreConfirmed) {
  FormationControl control(three(true));
  AgentOutput out;
  control.step({}, out);
  out = {};
  const NavEstimate there = nav(1, Vec3::Zero(), Vec3::Zero());
  const std::vector<Message> inbox = {report(EntityId{1}, 0, there),
                                      report(EntityId{2}, 1, there),
                                      report(EntityId{3}, 0, there)};
  AgentInput in;
  in.now = Time::from_seconds(3);
  in.inbox = inbox;
  control.step(in, out);
  ASSERT_EQ(out.outbox.size(), 2u);
  EXPECT_EQ(out.outbox[0].to, EntityId{1});
  EXPECT_EQ(out.outbox[1].to, EntityId{3});
}

TEST(FormationControl, ReplacesALeaderThatIsSilentForTooLong) {
  FormationControl control(three(false));
  std::vector<Time> led;
  for (double time = 0; time < 60; time += 1) {
    const NavEstimate there = nav(time, Vec3::Zero(), Vec3::Zero());
    // From 11 s on nothing is heard of the leader; 2 does not obey, 3 does.
    Message second = report(EntityId{2}, 1, there);
    std::get<AircraftReport>(second.content).obeys = false;
    std::vector<Message> inbox = {second, report(EntityId{3}, 1, there)};
    if (time <= 10) inbox.push_back(report(EntityId{1}, 1, there));
    AgentInput in;
    in.now = Time::from_seconds(time);
    in.inbox = inbox;
    AgentOutput out;
    control.step(in, out);
    for (const Event& event : out.events)
      if (event.kind == EventKind::kLeader && event.entity == EntityId{3})
        led.push_back(in.now);
  }
  // Heard last at 10 s, counted on for 5 s more, waited for during 30 s.
  ASSERT_EQ(led.size(), 1u);
  EXPECT_NEAR(led.front().seconds(), 46, 1);
  EXPECT_EQ(control.goal_number(), 1u);
  const auto goal = std::get<FormationGoal>(control.goal());
  EXPECT_EQ(goal.leader, EntityId{3});
  EXPECT_EQ(goal.followers, (std::vector<EntityId>{{1}, {2}}));
  EXPECT_EQ(goal.slots[1], Vec2(-30, -30));
}

// Paused, none of them is the mission's; afterwards whoever reports first is no heir.
TEST(FormationControl, KeepsItsLeaderThroughAPause) {
  FormationOptions options = three(false);
  options.leaders.resize(1);
  FormationControl control(options);
  for (double time = 0; time < 150; time += 1) {
    const bool paused = time > 20 && time < 100;
    std::vector<Message> inbox;
    for (std::uint32_t id = 1; id <= 3; ++id) {
      if (time == 100 && id == 1) continue;  // its report is lost
      inbox.push_back(report(EntityId{id}, 1, nav(time, Vec3::Zero(), Vec3::Zero())));
      std::get<AircraftReport>(inbox.back().content).obeys = !paused;
    }
    AgentInput in;
    in.now = Time::from_seconds(time);
    in.inbox = inbox;
    AgentOutput out;
    control.step(in, out);
  }
  EXPECT_EQ(control.goal_number(), 0u);
}

TEST(FormationControl, DoesNotAppointOneThatIsGone) {
  FormationControl control(three(false));  // at 100 s aircraft 3 is to lead
  for (double time = 0; time < 110; time += 1) {
    const NavEstimate there = nav(time, Vec3::Zero(), Vec3::Zero());
    std::vector<Message> inbox = {report(EntityId{1}, 1, there),
                                  report(EntityId{2}, 1, there)};
    if (time < 20) inbox.push_back(report(EntityId{3}, 1, there));
    AgentInput in;
    in.now = Time::from_seconds(time);
    in.inbox = inbox;
    AgentOutput out;
    control.step(in, out);
  }
  EXPECT_EQ(std::get<FormationGoal>(control.goal()).leader, EntityId{1});
}

TEST(FormationControl, KeepsALeaderWhenNobodyElseIsThere) {
  FormationControl control(three(false));
  AgentOutput out;
  for (double time = 0; time < 90; time += 1) {
    AgentInput in;
    in.now = Time::from_seconds(time);
    control.step(in, out);
  }
  EXPECT_EQ(control.goal_number(), 0u);
}

class FormationTasks : public testing::Test {
 protected:
  AgentOutput step(double time, std::vector<Message> inbox) {
    const NavEstimate own = nav(time, {0, 0, -altitude}, {20, 0, -climb});
    AgentInput in;
    in.now = Time::from_seconds(time);
    in.nav = &own;
    in.autopilot.on_ground = on_ground;
    in.autopilot.reaction = reaction;
    in.autopilot.trigger = trigger;
    in.inbox = inbox;
    AgentOutput out;
    wingman->step(in, out);
    return out;
  }
  Message task(std::uint32_t number, decltype(Task::what) what) {
    Message message;
    message.content = Task{number, std::move(what)};
    return message;
  }

  Plain ground;
  std::vector<Zone> zones;
  bool on_ground = false;
  double altitude = 150, climb = 0;
  FailsafeReaction reaction = FailsafeReaction::kNone;
  FailsafeTrigger trigger = FailsafeTrigger::kNone;
  FlightContext context{EntityId{2}, FlightLimits{}, &ground, nullptr, 120};
  MakeTask make =
      [](const TaskKind& task,
         const FlightContext& flown) -> Result<std::unique_ptr<TaskExecutor>> {
    using Made = std::unique_ptr<TaskExecutor>;
    if (const auto* route = std::get_if<FlyRoute>(&task))
      return Made(std::make_unique<RouteTask>(flown, *route, false));
    if (const auto* order = std::get_if<FollowLeader>(&task))
      return Made(std::make_unique<FollowTask>(flown, *order, 8));
    return Error{ErrorCode::kBadInput, "", "it cannot.", ""};
  };
  std::optional<OnboardAgent> wingman{
      std::in_place, OnboardAgentOptions{}, EntityId{0}, context, zones, make};
};

TEST_F(FormationTasks, LeadsAboveTheHighestGroundOfItsRouteAndReportsToWhomItShall) {
  const AgentOutput out =
      step(0, {task(1, FlyRoute{{{0, 0}, {1000, 0}}, 3, {EntityId{5}}})});
  ASSERT_TRUE(out.command);
  const auto& route = std::get<FlyWaypoints>(out.command->guidance);
  EXPECT_EQ(route.laps, 3);
  EXPECT_EQ(route.points.at(1).altitude_msl, 50 + 120);
  ASSERT_EQ(out.outbox.size(), 2u);
  EXPECT_EQ(std::get<TeamPosition>(out.outbox[0].content).aircraft, EntityId{2});
  EXPECT_EQ(out.outbox[0].to, EntityId{5});
  EXPECT_FALSE(step(0.5, {}).command) << "an order is given once";
}

TEST_F(FormationTasks, FollowsEachNewPositionOfItsLeaderAndNoOther) {
  EXPECT_TRUE(std::holds_alternative<HoldPosition>(
      step(0, {task(1, FollowLeader{EntityId{1}, {-30, 20}})}).command->guidance));
  const auto position = [](EntityId of, double time, const Vec3& v) {
    Message message;
    message.content = TeamPosition{of, nav(time, {100, 0, -200}, v)};
    return message;
  };
  EXPECT_TRUE(std::holds_alternative<HoldPosition>(
      step(1, {position(EntityId{7}, 1, {20, 0, 0})}).command->guidance));
  const auto out = step(1.5, {position(EntityId{1}, 1, {20, 0, 0})});
  const Plan& plan = std::get<FollowPlan>(out.command->guidance).plan;
  // From where it is to behind its leader.
  EXPECT_EQ(plan.front().p_N, Vec3(0, 0, -150));
  EXPECT_EQ(plan.front().time, Time::from_seconds(1.5));
  EXPECT_EQ(plan.back().time, Time::from_seconds(1.5 + 8));
  EXPECT_GT(plan.back().v_N.norm(), 20) << "it has to catch up";
  // Old news: the leader still goes north.
  const auto old = step(1.7, {position(EntityId{1}, 1, {0, 20, 0})});
  const Plan& same = std::get<FollowPlan>(old.command->guidance).plan;
  EXPECT_GT(same.back().p_N.x(), 150);
  // Now it turns.
  const auto turning =
      step(2, {position(EntityId{1}, 2, {20 * std::cos(0.5), 20 * std::sin(0.5), 0})});
  const Plan& bent = std::get<FollowPlan>(turning.command->guidance).plan;
  EXPECT_GT(bent.back().p_N.y(), same.back().p_N.y() + 20);
  const auto end_of_plan = [&](double time) {
    return std::get<FollowPlan>(step(time, {}).command->guidance).plan.back().time;
  };
  EXPECT_EQ(end_of_plan(21.9), Time::from_seconds(21.9 + 8));
  EXPECT_EQ(end_of_plan(22.1), Time::from_seconds(21.9 + 8))
      << "nothing was received for twenty seconds: the last plan is flown to its end";
}

TEST_F(FormationTasks, FollowingGoesOnAtTheHeightItHadPlannedWhateverAGustDoes) {
  step(0, {task(1, FollowLeader{EntityId{1}, {-30, 20}})});
  const auto heights = [&](double time) {
    Message message;
    message.content = TeamPosition{EntityId{1}, nav(time, {100, 0, -150}, {20, 0, 0})};
    return std::get<FollowPlan>(step(time, {message}).command->guidance).plan;
  };
  heights(1);
  altitude = 165, climb = 4;  // carried off
  for (const PlanPoint& point : heights(1.5)) EXPECT_NEAR(point.p_N.z(), -150, 1e-9);
  // Whom somebody else has flown begins anew.
  reaction = FailsafeReaction::kHold;
  EXPECT_NEAR(heights(2).front().p_N.z(), -165, 1e-9);
  reaction = FailsafeReaction::kNone;
  const Plan back = heights(2.5);
  EXPECT_LT(back.front().p_N.z(), -160);
  EXPECT_GT(back.back().p_N.z(), -160) << "down to the leader";
  // A leader that was lost for long is followed anew from where one is.
  altitude = 140, climb = 0;
  EXPECT_NEAR(heights(60).front().p_N.z(), -140, 1e-9);
}

TEST_F(FormationTasks, ReportsThatItDoesNotObeyWhereAFailsafeHasLandedIt) {
  const auto obeys = [&](double time) {
    return std::get<AircraftReport>(step(time, {}).outbox.at(0).content).obeys;
  };
  trigger = FailsafeTrigger::kBattery;
  EXPECT_TRUE(obeys(0)) << "it is reported, and flies on";
  on_ground = true;
  EXPECT_FALSE(obeys(2));
  trigger = FailsafeTrigger::kNone;
  EXPECT_TRUE(obeys(4)) << "it may take off";
}

TEST_F(FormationTasks, SwapsRolesAndKeepsTheNewestOrder) {
  step(0, {task(5, FollowLeader{EntityId{1}, {-30, 20}})});
  EXPECT_TRUE(std::holds_alternative<HoldPosition>(
      step(1, {task(4, FlyRoute{{{0, 0}, {1, 1}}, 1, {}})}).command->guidance));
  EXPECT_TRUE(std::holds_alternative<FlyWaypoints>(
      step(2, {task(6, FlyRoute{{{0, 0}, {1, 1}}, 1, {}})}).command->guidance));
}

TEST_F(FormationTasks, RefusesWhatItCannotDo) {
  const AgentOutput out = step(0, {task(1, FollowEdge{})});
  ASSERT_TRUE(out.command) << "it circles";
  EXPECT_TRUE(std::holds_alternative<Circle>(out.command->guidance));
  ASSERT_EQ(out.events.size(), 1u);
  EXPECT_EQ(out.events[0].kind, EventKind::kTaskRefused);
}

TEST_F(FormationTasks, TakesOffBeforeItLeads) {
  on_ground = true;
  step(0, {task(1, FlyRoute{{{0, 0}, {500, 0}, {500, 0}}, 3, {}})});
  const auto reported = step(5, {});
  EXPECT_TRUE(std::holds_alternative<TakeOff>(reported.command->guidance));
  EXPECT_EQ(reported.command->altitude_msl, 10 + 120);
  on_ground = false;
  const auto up = step(30, {});
  EXPECT_EQ(std::get<FlyWaypoints>(up.command->guidance).points.size(), 2u);
}

TEST_F(FormationTasks, FollowingTurnsAwayFromAZone) {
  zones = {{geo::Ring{{60, -300}, {60, 300}, {400, 300}, {400, -300}}}};
  wingman.emplace(OnboardAgentOptions{}, EntityId{0}, context, zones, make);
  const auto events = step(0, {task(1, FollowLeader{EntityId{1}, {-30, 20}})}).events;
  Message message;
  message.content = TeamPosition{EntityId{1}, nav(1, {100, 0, -200}, {20, 0, 0})};
  const auto out = step(1, {message});
  EXPECT_FALSE(std::holds_alternative<FollowPlan>(out.command->guidance));
  ASSERT_EQ(events.back().kind, EventKind::kZone) << "it turns away while it waits";
}

}  // namespace
}  // namespace skein::reasoning::formation_test
