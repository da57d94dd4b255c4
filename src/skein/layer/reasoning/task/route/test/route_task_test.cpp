// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/route/route_task.h"

#include <gtest/gtest.h>

#include <memory>

#include "skein/layer/reasoning/agent/onboard_agent.h"

namespace skein::reasoning::route_task_test {
namespace {

// A hill on the leg from the last point back to the first.
class Hill final : public Terrain {
 public:
  double elevation_msl(const Vec2& p) const override {
    return p.x() > 150 && p.x() < 250 && p.y() > 350 ? 80 : 10;
  }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};

struct Harness {
  explicit Harness(bool lands = false)
      : agent({.first_task = FlyRoute{{{400, 400}, {400, 0}, {0, 400}}, 5, {}}},
              EntityId{7}, context, {},
              [lands](const TaskKind& task, const FlightContext& flown) {
                return Result<std::unique_ptr<TaskExecutor>>(
                    std::make_unique<RouteTask>(flown, std::get<FlyRoute>(task), lands));
              }) {}
  AgentOutput at(double time, bool done = false) {
    nav.time = Time::from_seconds(time);
    AgentInput in;
    in.now = nav.time;
    in.nav = &nav;
    in.autopilot.done = done;
    in.autopilot.on_ground = on_ground;
    AgentOutput out;
    agent.step(in, out);
    return out;
  }
  Hill hill;
  FlightContext context{EntityId{1}, {}, &hill, nullptr, 100};
  OnboardAgent agent;
  NavEstimate nav;
  bool on_ground = false;
};

TEST(RouteTask, OrdersItsRouteOnceAboveTheHighestGroundOfIt) {
  Harness harness;
  const AgentOutput first = harness.at(0);
  ASSERT_TRUE(first.command);
  const auto& route = std::get<FlyWaypoints>(first.command->guidance);
  EXPECT_EQ(route.laps, 5);
  ASSERT_EQ(route.points.size(), 3u);
  EXPECT_EQ(route.points[1].point, Vec2(400, 0));
  for (const auto& point : route.points) EXPECT_DOUBLE_EQ(point.altitude_msl, 180);
  EXPECT_FALSE(harness.at(0.5).command);
}

TEST(RouteTask, ReportsToTheStationAndSaysOnceThatTheRouteIsDone) {
  Harness harness;
  int reports = 0, events = 0;
  bool done = false;
  for (int k = 0; k <= 20; ++k) {
    const AgentOutput out = harness.at(0.25 * k, k >= 10);
    for (const Message& message : out.outbox) {
      EXPECT_EQ(message.to, EntityId{7});
      if (const auto* report = std::get_if<AircraftReport>(&message.content)) {
        done = report->task_share == 1;
        ++reports;
      }
    }
    for (const Event& event : out.events) events += event.kind == EventKind::kRouteDone;
  }
  EXPECT_EQ(reports, 6);  // at 0 to 5 s
  EXPECT_TRUE(done);
  EXPECT_EQ(events, 1);
}

TEST(RouteTask, TakesOffAndLandsWhereItStood) {
  Harness harness(true);
  harness.on_ground = true;
  harness.nav.p_N = {30, 20, -10};
  EXPECT_FALSE(harness.at(0).command);
  const auto up = harness.at(5);
  EXPECT_TRUE(std::holds_alternative<TakeOff>(up.command->guidance));
  EXPECT_DOUBLE_EQ(up.command->altitude_msl, 180);
  harness.on_ground = false;
  EXPECT_FALSE(harness.at(10).command);
  EXPECT_TRUE(
      std::holds_alternative<FlyWaypoints>(harness.at(60, true).command->guidance));
  EXPECT_FALSE(harness.at(61).command);
  EXPECT_FALSE(harness.at(300, true).command);
  const auto down = harness.at(300.5, true);
  EXPECT_EQ(std::get<Land>(down.command->guidance).point, Vec2(30, 20));
  EXPECT_EQ(std::get<Land>(down.command->guidance).ground_msl, 10);
  EXPECT_FALSE(harness.at(301, true).command);
}

// The task alone, told how its flight goes.
struct Route {
  explicit Route(int laps) : task(context, {points, laps, {}}, false) {}

  const FlightIntent& after(const FlightProgress& flight) {
    AgentInput in;
    in.now = now;
    in.nav = &nav;
    now += Time::from_seconds(1);
    return *task.plan({in, {}, safety, beliefs, flight, intents}, out);
  }

  Hill hill;
  FlightContext context{EntityId{1}, {}, &hill, nullptr, 100};
  FlightSafety safety{{}, {}, EntityId{1}, FlightLimits{}, hill, {}};
  Beliefs beliefs{EntityId{0}};
  IntentCounter intents;
  NavEstimate nav;
  AgentOutput out;
  Time now;
  std::vector<Vec2> points{{400, 400}, {400, 0}, {0, 400}};
  RouteTask task;
};

// What keeps it apart from others flies on along the route: points passed so are passed.
TEST(RouteTask, WhatIsPassedInAnInterruptionIsNotFlownAgain) {
  Route route(2);
  const FlightIntent first = route.after({});
  route.task.interrupt();
  FlightProgress flight;
  flight.number = first.number;
  flight.passed = 1;
  const FlightIntent second = route.after(flight);
  EXPECT_NE(second.number, first.number);
  const auto& left = std::get<Legs>(second.what);
  ASSERT_EQ(left.points.size() * static_cast<std::size_t>(left.laps), 5u);
  EXPECT_EQ(left.points.front(), Vec2(400, 0));
  route.task.interrupt();
  flight.number = second.number;
  flight.passed = 5;
  flight.done = true;
  const FlightIntent third = route.after(flight);
  EXPECT_TRUE(route.task.progress({}).done);
  EXPECT_EQ(std::get<Circling>(third.what).centre, Vec2(0, 400)) << "it stays there";
}

}  // namespace
}  // namespace skein::reasoning::route_task_test
