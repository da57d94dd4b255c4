// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "skein/layer/reasoning/agent/onboard_agent.h"
#include "skein/layer/reasoning/task/course/course_task.h"
#include "skein/layer/reasoning/task/edge/edge_task.h"
#include "skein/layer/reasoning/task/go_to/go_to_task.h"
#include "skein/layer/reasoning/task/line/line_task.h"
#include "skein/layer/reasoning/task/stay/stay_task.h"
#include "skein/layer/reasoning/trajectory/altitude.h"
#include "skein/layer/reasoning/trajectory/test/test_flight.h"

namespace skein::reasoning::onboard_tasks_test {
namespace {

constexpr EntityId kSelf{3}, kStation{0};

// An agent in its aircraft, stepped once a second.
class Mission {
 public:
  explicit Mission(const std::vector<Zone>& zones = {}, const Vec2& wind = Vec2::Zero(),
                   std::optional<double> edge_angle = {})
      : context{kSelf, FlightLimits{}, &ground, nullptr, 120},
        agent({}, kStation, context, zones,
              [this](const TaskKind& task, const FlightContext& flown) {
                return make(task, flown);
              }),
        own_angle(edge_angle) {
    aircraft.wind = wind;
  }

  Result<std::unique_ptr<TaskExecutor>> make(const TaskKind& task,
                                             const FlightContext& flown) const {
    using Made = std::unique_ptr<TaskExecutor>;
    if (const auto* order = std::get_if<Loiter>(&task))
      return Made(std::make_unique<StayTask>(*order));
    if (const auto* order = std::get_if<FlyTo>(&task))
      return Made(std::make_unique<GoToTask>(flown, *order));
    if (const auto* order = std::get_if<FlyCourse>(&task))
      return Made(std::make_unique<CourseTask>(flown, *order));
    if (const auto* order = std::get_if<FollowLine>(&task))
      return Made(std::make_unique<LineTask>(flown, *order));
    FollowEdge order = std::get<FollowEdge>(task);
    order.angle = own_angle.value_or(order.angle);
    return Made(std::make_unique<EdgeTask>(flown, EdgeFollowerOptions{}, order));
  }

  void send(std::uint32_t number, decltype(Task::what) what) {
    Message m;
    m.from = kStation;
    m.to = kSelf;
    m.content = Task{number, std::move(what)};
    inbox.push_back(m);
  }

  // One second; returns what the agent said.
  AgentOutput second(std::vector<SensorSample> samples = {}) {
    const NavEstimate nav = aircraft.nav(now);
    AgentOutput out;
    agent.step({now, &nav, aircraft.status, samples, inbox, {}}, out);
    inbox.clear();
    if (out.command) aircraft.obey(*out.command);
    for (int i = 0; i < 20; ++i) aircraft.step(0.05);
    now += Time::from_seconds(1);
    return out;
  }

  void fly(int seconds, const std::function<void()>& watch = {}) {
    for (int i = 0; i < seconds; ++i) {
      second();
      if (watch) watch();
    }
  }

  test::FlatGround ground;
  test::TestAircraft aircraft;
  FlightContext context;
  OnboardAgent agent;
  std::optional<double> own_angle;
  std::vector<Message> inbox;
  Time now;
};

template <class T>
std::vector<T> contents(const AgentOutput& out) {
  std::vector<T> found;
  for (const Message& m : out.outbox)
    if (const auto* c = std::get_if<T>(&m.content)) found.push_back(*c);
  return found;
}

TEST(OnboardTask, PlacesReadingsByTheEstimateAndSendsThem) {
  Mission mission;
  mission.second();
  mission.aircraft.p = {1000, 500, -220};
  mission.aircraft.heading = 0;
  const Time seen = mission.now - Time::from_seconds(0.5);
  const AgentOutput out = mission.second({FireSample{seen, 40, true}});
  const auto readings = contents<FireReading>(out);
  ASSERT_EQ(readings.size(), 1U);
  EXPECT_EQ(readings[0].time, seen);
  EXPECT_EQ(readings[0].aircraft, kSelf);
  EXPECT_TRUE(readings[0].inside);
  // Half a second ago it was 10 m further south, looking 40 m ahead.
  EXPECT_LT((readings[0].point - Vec2(1030, 500)).norm(), 1e-6);
  EXPECT_EQ(out.outbox.front().to, kStation);
}

TEST(OnboardTask, ReportsOnceASecond) {
  Mission mission;
  int reports = 0;
  for (int i = 0; i < 40; ++i) {  // stepped at 4 Hz
    const NavEstimate nav = mission.aircraft.nav(mission.now);
    AgentOutput out;
    mission.agent.step({mission.now, &nav, {}, {}, {}, {}}, out);
    reports += static_cast<int>(contents<AircraftReport>(out).size());
    mission.now += Time::from_seconds(0.25);
  }
  EXPECT_EQ(reports, 10);
}

TEST(OnboardTask, FliesThroughAPointInWindAndSaysSo) {
  for (const double direction : {0.0, 1.5, 3.0, -1.5}) {
    Mission mission({}, 8 * geo::unit(direction));
    mission.send(1, FlyTo{{700, -400}});
    double nearest = 1e9;
    mission.fly(120, [&] {
      if (!mission.agent.task_done())
        nearest =
            std::min(nearest, (mission.aircraft.position() - Vec2(700, -400)).norm());
    });
    EXPECT_TRUE(mission.agent.task_done());
    EXPECT_LT(nearest, 30);  // looked at once a second: up to 28 m apart
    const auto report = contents<AircraftReport>(mission.second());
    ASSERT_EQ(report.size(), 1U);
    EXPECT_EQ(report[0].task_state, TaskState::kDone);
    EXPECT_EQ(report[0].task_number, 1U);
    // Then it stays near.
    mission.fly(60, [&] {
      EXPECT_LT((mission.aircraft.position() - Vec2(700, -400)).norm(), 350);
    });
  }
}

TEST(OnboardTask, ReachesAPointInsideItsTurningCircle) {
  Mission mission;
  mission.send(1, FlyTo{{0, 60}});
  double nearest = 1e9;
  mission.fly(60, [&] {
    nearest = std::min(nearest, (mission.aircraft.position() - Vec2(0, 60)).norm());
  });
  EXPECT_TRUE(mission.agent.task_done());
  EXPECT_LT(nearest, 25);
}

TEST(OnboardTask, KeepsTheNewestTask) {
  Mission mission;
  mission.send(5, FlyCourse{1.0});
  mission.send(4, FlyCourse{-1.0});
  mission.fly(30);
  EXPECT_EQ(mission.agent.task_number(), 5U);
  EXPECT_NEAR(geo::bearing(mission.aircraft.velocity()), 1.0, 0.01);
  mission.send(5, FlyCourse{2.0});  // received twice
  mission.fly(30);                  // no messages: goes on
  EXPECT_NEAR(geo::bearing(mission.aircraft.velocity()), 1.0, 0.01);
}

TEST(OnboardTask, FollowsALineOnce) {
  Mission mission({}, {0, 6});
  FollowLine line;
  for (int i = 0; i <= 20; ++i)
    line.points.push_back(Vec2(500, 0) + 400 * geo::unit(geo::kPi + i * geo::kPi / 10));
  mission.send(1, line);
  double worst = 0;
  int followed = 0;
  mission.fly(250, [&] {
    if (mission.agent.task_done() || mission.now.seconds() < 25) return;
    ++followed;
    worst = std::max(worst,
                     std::abs((mission.aircraft.position() - Vec2(500, 0)).norm() - 400));
  });
  EXPECT_TRUE(mission.agent.task_done());
  EXPECT_GT(followed, 80);  // 2500 m at 14 to 26 m/s
  EXPECT_LT(worst, 40);
}

TEST(OnboardTask, LoitersAtItsTask) {
  Mission mission({}, {5, 0});
  mission.send(1, Loiter{{800, 800}});
  mission.fly(150);
  mission.fly(120, [&] {
    EXPECT_LT((mission.aircraft.position() - Vec2(800, 800)).norm(), 160);
  });
}

TEST(OnboardTask, CirclesUntilTheFirstTask) {
  Mission mission;
  mission.fly(200, [&] { EXPECT_LT(mission.aircraft.position().norm(), 250); });
}

TEST(OnboardTask, FollowsAFire) {
  Mission mission({}, {3, 3});
  mission.aircraft.p = {-800, 0, -220};
  mission.send(1, FollowEdge{true, {-500, 0}, {0, -1}});
  int crossings = 0, n = 0;
  double sum = 0;
  bool last = false;
  for (int i = 0; i < 600; ++i) {
    const bool inside = mission.aircraft.position().norm() < 500;
    mission.second({FireSample{mission.now, 0, inside}});
    if (i < 60) continue;
    crossings += inside != last ? 1 : 0;
    last = inside;
    sum += std::abs(mission.aircraft.position().norm() - 500);
    ++n;
  }
  EXPECT_GT(crossings, 60);
  EXPECT_LT(sum / n, 40);
  EXPECT_FALSE(mission.agent.task_done());
}

// Crossings in ten minutes along the edge of a half-plane, `angle` being ordered.
int crossings_along_edge(double angle, std::optional<double> own) {
  Mission mission({}, Vec2::Zero(), own);
  mission.aircraft.p = {-200, 0, -220};
  mission.send(1, FollowEdge{true, {0, 0}, {0, -1}, angle});
  int crossings = 0;
  bool last = false;
  for (int i = 0; i < 600; ++i) {
    const bool inside = mission.aircraft.position().x() > 0;
    mission.second({FireSample{mission.now, 0, inside}});
    crossings += inside != last ? 1 : 0;
    last = inside;
  }
  return crossings;
}

TEST(OnboardTask, CrossesTheEdgeAtItsOwnAngleWhateverIsOrdered) {
  const double flat = geo::radians(25), steep = geo::radians(80);
  const int as_ordered = crossings_along_edge(flat, std::nullopt);
  const int own = crossings_along_edge(flat, steep);
  EXPECT_EQ(own, crossings_along_edge(steep, std::nullopt));
  EXPECT_NE(own, as_ordered);
  // An order without an angle leaves it to the aircraft.
  EXPECT_EQ(crossings_along_edge(0, steep), own);
  EXPECT_EQ(crossings_along_edge(0, std::nullopt),
            crossings_along_edge(EdgeFollowerOptions{}.angle, std::nullopt));
}

TEST(OnboardTask, NeverEntersAZoneWhateverItsTask) {
  const std::vector<Zone> zones{
      {.area = geo::Ring{{-200, -300}, {300, -300}, {300, 300}, {-200, 300}}},
      {.area = geo::Ring{{600, -200}, {900, -200}, {900, 200}, {600, 200}}}};
  const std::vector<decltype(Task::what)> tasks{FlyTo{{450, 0}},
                                                FlyTo{{0, 0}},
                                                FlyCourse{0},
                                                Loiter{{50, 0}},
                                                FollowLine{{{-800, 0}, {1500, 0}}},
                                                FollowEdge{true, {100, 0}, {0, 1}}};
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    for (int i = 0; i < 4; ++i) {
      Mission mission(zones, 8 * geo::unit(i * geo::kPi / 2 + 0.3));
      mission.aircraft.p = {-1000, 20, -220};
      mission.send(1, tasks[k]);
      const ZoneAvoidance avoidance({}, FlightLimits{}, zones);
      double nearest = 1e9;
      for (int t = 0; t < 240; ++t) {
        mission.second(
            {FireSample{mission.now, 0, mission.aircraft.position().norm() < 500}});
        nearest = std::min(nearest, avoidance.distance(mission.aircraft.position()));
      }
      EXPECT_GT(nearest, 0) << "task " << k << ", wind " << i;
    }
  }
}

TEST(OnboardTask, PassesAZoneOnItsPath) {
  const std::vector<Zone> zones{
      {.area = geo::Ring{{-200, -300}, {300, -300}, {300, 300}, {-200, 300}}}};
  Mission mission(zones, {0, 4});
  mission.aircraft.p = {-1000, 20, -220};
  mission.send(1, FlyTo{{1000, 0}});
  bool reported = false;
  for (int t = 0; t < 300; ++t)
    for (const Event& e : mission.second().events) reported |= e.kind == EventKind::kZone;
  EXPECT_TRUE(reported);
  EXPECT_TRUE(mission.agent.task_done());
}

class Ridge final : public Terrain {
 public:
  double elevation_msl(const Vec2& p) const override {
    return 200 + 150 * std::exp(-std::pow((p.x() - 2000) / 400, 2));
  }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};

TEST(AltitudeOver, ClearsARidgeWithinTheClimbRate) {
  const Ridge ridge;
  double altitude = 320, x = 0, lowest = 1e9;
  for (int i = 0; i < 200; ++i, x += 20) {
    const double setpoint = altitude_over(ridge, {x, 0}, {20, 0}, 120, 3);
    altitude += std::clamp(setpoint - altitude, -3.0, 3.0);
    lowest = std::min(lowest, altitude - ridge.elevation_msl({x, 0}));
  }
  EXPECT_GT(lowest, 110);  // decided once a second, the climb lags by 3 m
  EXPECT_NEAR(altitude_over(ridge, {-5000, 0}, {20, 0}, 120, 3), 320, 0.1);
}

TEST(OnboardTask, AStationWithoutVehicleStaysSilent) {
  Mission mission;
  AgentOutput out;
  mission.agent.step({Time(), nullptr, {}, {}, {}, {}}, out);
  EXPECT_TRUE(out.outbox.empty());
  EXPECT_FALSE(out.command.has_value());
}

Message zone_on(std::uint32_t number, const Vec2& centre, double radius) {
  Message message;
  message.content = ZoneChange{number, true, {.area = Disc{centre, radius}, .name = "a"}};
  return message;
}

bool says(const AgentOutput& out, EventKind kind) {
  return std::any_of(out.events.begin(), out.events.end(),
                     [&](const Event& event) { return event.kind == kind; });
}

TEST(OnboardTask, AZoneTakesEffectInTheStepInWhichItIsReceived) {
  Mission mission;
  mission.send(1, FlyCourse{0});
  mission.fly(20);
  const Vec2 here = mission.aircraft.position();
  mission.inbox.push_back(zone_on(1, here + Vec2(200, 0), 100));
  const AgentOutput out = mission.second();
  EXPECT_TRUE(says(out, EventKind::kZoneOn));
  ASSERT_TRUE(out.command);
  const auto* hold = std::get_if<HoldCourse>(&out.command->guidance);
  EXPECT_TRUE(!hold || std::abs(geo::wrap_pi(hold->course)) > 0.5);
  double nearest = 1e9;
  bool reported = false;
  for (int k = 0; k < 60; ++k) {
    const auto reports = contents<AircraftReport>(mission.second());
    if (!reports.empty()) reported = reported || reports[0].zone_changes == 1;
    nearest =
        std::min(nearest, (mission.aircraft.position() - here - Vec2(200, 0)).norm());
  }
  EXPECT_GT(nearest, 100);
  EXPECT_TRUE(reported);
}

TEST(OnboardTask, GoesToTheNearestPlaceInsteadOfOneInAZone) {
  for (const bool circles : {false, true}) {
    Mission mission;
    if (circles)
      mission.send(1, Loiter{{1000, 0}});
    else
      mission.send(1, FlyTo{{1000, 0}});
    mission.fly(5);
    mission.inbox.push_back(zone_on(1, {1050, 0}, 300));
    EXPECT_TRUE(says(mission.second(), EventKind::kTaskMoved));
    double nearest = 1e9;
    mission.fly(200, [&] {
      nearest = std::min(nearest, (mission.aircraft.position() - Vec2(1050, 0)).norm());
    });
    EXPECT_GT(nearest, 300);
    EXPECT_LT((mission.aircraft.position() - Vec2(1050, 0)).norm(), 560);
    EXPECT_EQ(mission.agent.task_done(), !circles);
    // Taken back, the place is the task's own again.
    Message off;
    off.content = ZoneChange{2, false, {.name = "a"}};
    mission.inbox.push_back(off);
    EXPECT_TRUE(says(mission.second(), EventKind::kTaskMoved));
    nearest = 1e9;
    mission.fly(100, [&] {
      nearest = std::min(nearest, (mission.aircraft.position() - Vec2(1000, 0)).norm());
    });
    EXPECT_LT(nearest, 120);
  }
}

TEST(OnboardTask, ZonesAboveAndBelowDoNotConcernIt) {
  Mission above, below, free;
  Message high = zone_on(1, {500, 0}, 200), low = high;
  std::get<ZoneChange>(high.content).zone.floor_msl = 241;
  std::get<ZoneChange>(low.content).zone.ceiling_msl = 199;
  above.inbox.push_back(high);
  below.inbox.push_back(low);
  for (Mission* mission : {&above, &below, &free}) {
    mission->send(1, FlyCourse{0});
    mission->fly(60);
  }
  EXPECT_EQ(above.aircraft.p, free.aircraft.p);
  EXPECT_EQ(below.aircraft.p, free.aircraft.p);
}

}  // namespace
}  // namespace skein::reasoning::onboard_tasks_test
