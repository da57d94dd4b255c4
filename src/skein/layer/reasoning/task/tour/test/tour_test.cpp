// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "skein/layer/reasoning/agent/onboard_agent.h"
#include "skein/layer/reasoning/task/tour/tour_task.h"
#include "skein/model/path/flight_plan.h"
#include "skein/model/path/plan_curve.h"

namespace skein::reasoning::tour_test {
namespace {

const std::vector<Vec2> kTriangle = {{0, 0}, {600, 0}, {300, 500}};
const model::AirMotion kAir{15, 40, {3, 4}};

TEST(CornerCourses, CrossTheBisector) {
  const std::vector<Vec2> square = {{0, 0}, {100, 0}, {100, 100}, {0, 100}};
  const std::vector<double> courses = corner_courses(square);
  // Clockwise around the square: at (0, 0) coming from the east, leaving to the north.
  EXPECT_NEAR(courses[0], geo::radians(-45), 1e-12);
  EXPECT_NEAR(courses[1], geo::radians(45), 1e-12);
  EXPECT_NEAR(courses[2], geo::radians(135), 1e-12);
  // There and back: the course of the path to it.
  const std::vector<double> line = corner_courses(std::vector<Vec2>{{0, 0}, {0, 500}});
  EXPECT_NEAR(line[1], geo::radians(90), 1e-12);
}

class TourPlans : public testing::TestWithParam<TourCurves> {};

TEST_P(TourPlans, PassThePointsAtTheirCourses) {
  const std::vector<double> courses = corner_courses(kTriangle);
  const TourPlan tour =
      plan_tour({{-200, 50, -100}, 0.4}, 7, kTriangle, courses, kAir, GetParam());
  ASSERT_EQ(tour.passes.size(), 3u);
  EXPECT_EQ(model::start_of(tour.plan), 7);
  for (std::size_t i = 0; i < 3; ++i) {
    const model::FlightMoment at = model::moment_at(tour.plan, tour.passes[i]);
    EXPECT_LT((geo::horizontal(at.p_N) - kTriangle[i]).norm(), 1e-6);
    EXPECT_NEAR(geo::wrap_pi(geo::bearing(geo::horizontal(at.v_N)) - courses[i]), 0,
                1e-9);
    EXPECT_EQ(at.p_N.z(), -100);
  }
  for (const FlightElement& e : tour.plan)
    EXPECT_EQ(e.wind,
              GetParam() == TourCurves::kTrochoids ? kAir.wind : Vec2(Vec2::Zero()));
}

INSTANTIATE_TEST_SUITE_P(Curves, TourPlans,
                         testing::Values(TourCurves::kTrochoids, TourCurves::kDubins));

class Flat final : public Terrain {
 public:
  double elevation_msl(const Vec2&) const override { return 30; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};

// The agent, and an aircraft that is exactly where its plan says.
struct Flight {
  explicit Flight(const TourOptions& options, int laps = 2)
      : agent({.first_task = FlyTour{kTriangle, laps}}, EntityId{0}, context, {},
              [options](const TaskKind& task, const FlightContext& flown) {
                return Result<std::unique_ptr<TaskExecutor>>(
                    std::make_unique<TourTask>(flown, std::get<FlyTour>(task), options));
              }) {
    nav.p_N = {-200, 50, -150};
    nav.heading = 0.4;
    nav.wind_N = kAir.wind;
  }
  AgentOutput step(double time) {
    in.now = nav.time = Time::from_seconds(time);
    in.nav = &nav;
    in.autopilot.done = false;
    if (!curve.empty()) {
      const auto at = curve.at(std::min(time, curve.end()));
      nav.p_N = at.p_N;
      nav.v_N = at.v_N;
      nav.heading = geo::bearing(geo::horizontal(at.v_N) - nav.wind_N);
      in.autopilot.done = time > curve.end();
    }
    AgentOutput out;
    agent.step(in, out);
    if (out.command)
      if (const auto* f = std::get_if<FollowPlan>(&out.command->guidance))
        curve.assign(f->plan);
    for (const Event& e : out.events) reported.push_back(e.kind);
    return out;
  }
  bool has_reported(EventKind kind) const {
    return std::count(reported.begin(), reported.end(), kind) > 0;
  }
  Flat flat;
  FlightContext context{EntityId{1}, {15, 40, 3, 11, 20, 3}, &flat, nullptr, 120};
  OnboardAgent agent;
  NavEstimate nav;
  AgentInput in;
  model::PlanCurve curve;
  std::vector<EventLabel> reported;
};

TEST(TourTask, CirclesThenFliesAllLapsWithoutAGap) {
  Flight flight({});
  const AgentOutput first = flight.step(0);
  ASSERT_TRUE(first.command);
  EXPECT_TRUE(std::holds_alternative<HoldPosition>(first.command->guidance));
  EXPECT_EQ(first.command->altitude_msl, 150);
  EXPECT_TRUE(std::holds_alternative<HoldPosition>(flight.step(29.5).command->guidance));
  int plans = 0;
  std::vector<double> nearest(3, 1e9);
  Vec3 last = flight.nav.p_N;
  for (double time = 30; time < 600 && !flight.has_reported(EventKind::kRouteDone);
       time += 0.5) {
    const AgentOutput out = flight.step(time);
    plans += out.command && std::holds_alternative<FollowPlan>(out.command->guidance);
    // 15 m/s of air, 5 of wind, half a second.
    EXPECT_LT((flight.nav.p_N - last).norm(), 10.1) << time;
    last = flight.nav.p_N;
    for (std::size_t i = 0; i < 3; ++i)
      nearest[i] = std::min(nearest[i], (geo::horizontal(last) - kTriangle[i]).norm());
  }
  EXPECT_TRUE(flight.has_reported(EventKind::kRouteDone));
  EXPECT_EQ(plans, 2);
  for (const double distance : nearest) EXPECT_LT(distance, 5);  // within half a second
}

TEST(TourTask, FliesAtCruiseOnlyWhenItDoesNotKeepTimes) {
  for (const bool keeps : {true, false}) {
    TourOptions options;
    options.keeps_times = keeps;
    options.settling = 0;
    Flight flight(options);
    const AgentOutput out = flight.step(0);
    ASSERT_TRUE(out.command);
    EXPECT_EQ(out.command->airspeed.has_value(), !keeps);
  }
}

TEST(TourTask, PlansAnewWhatIsLeftWhenItIsOffThePlan) {
  TourOptions options;
  options.settling = 0;
  Flight flight(options);
  flight.step(0);
  const double end = flight.curve.end();
  flight.step(60);  // the first point is behind
  flight.in.autopilot.follows = true;
  flight.in.autopilot.cross_track = 1000;
  const AgentOutput off = flight.step(60.5);
  EXPECT_TRUE(flight.has_reported(EventKind::kOffPlan));
  const AgentOutput again = off.command ? off : flight.step(61);
  ASSERT_TRUE(again.command);
  const auto& plan = std::get<FollowPlan>(again.command->guidance).plan;
  EXPECT_LT((plan.front().p_N - flight.nav.p_N).norm(), 10);
  // Two points are left of the lap, not three.
  EXPECT_NEAR(plan.back().time.seconds(), end, 5);
}

TEST(TourTask, PlansAgainWhenItsPlanIsRefused) {
  TourOptions options;
  options.settling = 0;
  Flight flight(options, 1);
  ASSERT_TRUE(flight.step(0).command);
  // The autopilot goes on with what it flew before, which it may have done.
  flight.curve = {};
  flight.in.command_fate.state = CommandFate::State::kRefused;
  flight.step(0.5);
  for (double time = 1; time < 11; time += 0.5)
    EXPECT_TRUE(std::holds_alternative<Circle>(flight.step(time).command->guidance))
        << time;
  const AgentOutput again = flight.step(11);
  ASSERT_TRUE(again.command);
  const auto& plan = std::get<FollowPlan>(again.command->guidance).plan;
  EXPECT_EQ(plan.front().time.seconds(), 11);
  EXPECT_FALSE(flight.has_reported(EventKind::kRouteDone));
}

TEST(TourTask, ReportsOnceThatTheWindIsTooStrongAndTriesAgain) {
  TourOptions options;
  options.settling = 0;
  Flight flight(options);
  flight.nav.wind_N = {0, 16};
  for (double time = 0; time < 5; time += 0.5) flight.step(time);
  EXPECT_EQ(flight.reported, std::vector<EventLabel>{EventKind::kNoPlan});
  flight.nav.wind_N = {0, 3};
  EXPECT_TRUE(flight.step(5).command);
}

}  // namespace
}  // namespace skein::reasoning::tour_test
