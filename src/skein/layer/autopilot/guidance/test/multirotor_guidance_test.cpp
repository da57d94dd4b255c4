// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/guidance/multirotor_guidance.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <functional>

#include "skein/layer/autopilot/guidance/test/point_rotor.h"
#include "skein/model/path/path_geometry.h"

namespace skein::autopilot::multirotor_guidance_test {
namespace {

struct Flight {
  explicit Flight(const Vec2& wind = Vec2::Zero(),
                  const MultirotorGuidanceOptions& options = {},
                  const Vec3& home = {0, 0, -50})
      : guidance(options, PointRotor::airframe(), home) {
    rotor.wind = wind;
    rotor.p = home;
  }
  // Flies on; the reference keeps its bounds at every step.
  void fly(double seconds, const std::function<void()>& watch = {}) {
    const int steps = static_cast<int>(std::lround(seconds / PointRotor::kStep));
    for (int i = 0; i < steps; ++i) {
      const MultirotorDemand last = demand;
      demand = guidance.step(rotor.nav(), PointRotor::kStep);
      // The bounds of the options: acceleration 3 m/s^2, jerk 15 m/s^3, climb 2 m/s^2.
      EXPECT_LE(demand.acceleration.norm(), 3 + 1e-9);
      if (flown++ > 0) {
        EXPECT_LE((demand.acceleration - last.acceleration).norm(), 0.15 + 1e-9);
        EXPECT_LE(std::abs(demand.climb_rate - last.climb_rate), 0.02 + 1e-9);
      }
      rotor.step(demand);
      if (watch) watch();
    }
  }
  std::optional<std::string> command(const AutopilotCommand& command) {
    return guidance.command(command, rotor.nav());
  }
  Vec2 position() const { return rotor.p.head<2>(); }
  // Flies until done; the time it took, or the maximum.
  double fly_until_done(double max, const std::function<void()>& watch = {}) {
    double time = 0;
    for (; time < max && !guidance.status().done; time += PointRotor::kStep)
      fly(PointRotor::kStep, watch);
    EXPECT_TRUE(guidance.status().done);
    return time;
  }

  PointRotor rotor;
  MultirotorGuidance guidance;
  MultirotorDemand demand;
  int flown = 0;
};

TEST(MultirotorGuidance, StaysWhereItIsUntilTheFirstCommand) {
  Flight flight;
  flight.rotor.p = {30, -20, -70};
  flight.fly(20);
  EXPECT_LT((flight.rotor.p - Vec3(30, -20, -70)).norm(), 1e-6);
}

TEST(MultirotorGuidance, GoesToAPointWithoutOvershoot) {
  for (const double distance : {2.0, 20.0, 200.0}) {
    Flight flight;
    ASSERT_FALSE(flight.command({HoldPosition{{distance, 0}}, 60, {}}));
    double furthest = 0, highest = 0;
    flight.fly(distance / 10 + 15, [&] {
      furthest = std::max(furthest, flight.demand.position.x());
      highest = std::max(highest, flight.demand.altitude_msl);
    });
    EXPECT_LT(furthest, distance + 0.02);
    EXPECT_LT(highest, 60.02);
    EXPECT_NEAR(flight.position().x(), distance, 0.1);
    EXPECT_NEAR(-flight.rotor.p.z(), 60, 0.1);
    EXPECT_TRUE(flight.guidance.status().done);
  }
}

TEST(MultirotorGuidance, StopsAtCornersAndFliesAroundThemWhenItMay) {
  const std::vector<FlyWaypoints::Waypoint> points = {
      {{60, 0}, 50}, {{60, 60}, 56}, {{0, 60}, 56}, {{0, 0}, 50}};
  double stopping = 0;
  for (const double cut : {0.0, 2.0}) {
    MultirotorGuidanceOptions options;
    options.corner_cut = cut;
    Flight flight({4, 0}, options);
    ASSERT_FALSE(flight.command({FlyWaypoints{points, 2}, 50, {}}));
    std::vector<double> nearest(4, 1e9);
    double worst = 0, overshoot = 0;
    const double time = flight.fly_until_done(300, [&] {
      for (std::size_t k = 0; k < 4; ++k)
        nearest[k] = std::min(nearest[k], (flight.position() - points[k].point).norm());
      worst = std::max(worst, std::abs(flight.guidance.status().cross_track));
      overshoot = std::max(
          {overshoot, flight.demand.position.x() - 60, flight.demand.position.y() - 60});
    });
    std::printf("corner cut %.0f m: %.1f s, cross-track %.2f, corner passed at %.2f m\n",
                cut, time, worst, nearest[1]);
    if (cut == 0) stopping = time;
    // With 3 m/s^2 and 10 m/s in 4 m/s wind a leg of 60 m takes about 12 s.
    EXPECT_LT(time, cut > 0 ? stopping - 5 : 130);
    EXPECT_LT(overshoot, 0.1);  // creeping through at 0.2 m/s, taken out at 4/s
    EXPECT_LT(worst, 0.5);
    for (const double d : nearest) EXPECT_LT(d, cut + 0.5);
    EXPECT_NEAR(-flight.rotor.p.z(), 50, 0.2);
  }
}

TEST(MultirotorGuidance, FollowsAPathAndStopsAtItsEnd) {
  const Path path = {{{0, 0}, 0, 50, 0},
                     {{50, 0}, 0, geo::kPi * 8, 1 / 8.0},
                     {{50, 16}, geo::kPi, 40, 0}};
  Flight flight;
  ASSERT_FALSE(flight.command({FollowPath{path}, 50, {}}));
  double worst = 0;
  flight.fly_until_done(60, [&] {
    double along = 0;
    if (!flight.guidance.status().follows) return;
    const auto at = model::project(path, flight.position(), along, 200);
    worst = std::max(worst, std::abs(at.cross_track));
  });
  std::printf("path with a turn of 8 m: cross-track %.2f m\n", worst);
  EXPECT_LT(worst, 0.5);
  flight.fly(5);
  EXPECT_LT((flight.position() - Vec2(10, 16)).norm(), 0.05);
}

TEST(MultirotorGuidance, CirclesInBothSenses) {
  for (const bool clockwise : {true, false})
    for (const double wind : {0.0, 6.0}) {
      Flight flight({0, wind});
      ASSERT_FALSE(flight.command({Circle{{100, 0}, 30, clockwise}, 50, {}}));
      flight.fly(40);
      double worst = 0, turned = 0;
      Vec2 last = flight.position() - Vec2(100, 0);
      flight.fly(40, [&] {
        const Vec2 now = flight.position() - Vec2(100, 0);
        worst = std::max(worst, std::abs(now.norm() - 30));
        turned += std::asin(geo::cross(last, now) / (last.norm() * now.norm()));
        last = now;
      });
      EXPECT_LT(worst, 0.5);
      EXPECT_GT(clockwise ? turned : -turned, 6);
      // The nose points along the circle, behind by its turn rate's share of a step.
      const Vec2 v = flight.demand.velocity;
      EXPECT_NEAR(geo::wrap_pi(flight.demand.heading - geo::bearing(v)), 0, 0.05);
    }
}

TEST(MultirotorGuidance, IsWhereThePlanSaysWhenItSays) {
  // Along a straight and a circle at 6 m/s, from 5 s on; the start is 8 m away.
  Plan plan;
  for (int i = 0; i <= 20; ++i) {
    const double t = 5 + i, angle = 6.0 * i / 40;
    const Vec2 p = 40 * Vec2(std::sin(angle), 1 - std::cos(angle));
    const Vec2 v = 6 * geo::unit(angle);
    plan.push_back(
        {Time::from_seconds(t), {p.x(), p.y(), -50.0 - i}, {v.x(), v.y(), -1}});
  }
  Flight flight({3, 3});
  flight.rotor.p = {-8, 0, -50};
  ASSERT_FALSE(flight.command({FollowPlan{plan}, 0, {}}));
  flight.fly(12);
  double worst = 0, late = 0;
  model::PlanCurve curve;
  curve.assign(plan);
  flight.fly(12.5, [&] {
    const Vec3 setpoint = curve.at(flight.rotor.time.seconds()).p_N;
    worst = std::max(worst, (setpoint - flight.rotor.p).norm());
    late = std::max(late, std::abs(flight.guidance.status().time_error));
  });
  std::printf("plan: %.2f m, %.3f s\n", worst, late);
  EXPECT_LT(worst, 0.5);
  EXPECT_LT(late, 0.05);
  flight.fly(10);
  EXPECT_TRUE(flight.guidance.status().done);
  EXPECT_LT((flight.rotor.p - plan.back().p_N).norm(), 0.1);
}

TEST(MultirotorGuidance, TakesOffLandsAndReturns) {
  Flight flight({3, 0}, {}, {0, 0, 0});
  ASSERT_FALSE(flight.command({TakeOff{}, 20, {}}));
  flight.fly(2);
  EXPECT_EQ(flight.demand.phase, FlightPhase::kClimbOut);
  flight.fly_until_done(20, [&] { EXPECT_LT(flight.position().norm(), 0.1); });
  ASSERT_FALSE(flight.command({HoldPosition{{80, 40}}, 20, {}}));
  flight.fly(30);

  // Up to 30 m above home first, then back.
  ASSERT_FALSE(flight.command({Return{}, 10, {}}));
  flight.fly(3);
  EXPECT_LT((flight.position() - Vec2(80, 40)).norm(), 0.5);
  flight.fly_until_done(40);
  EXPECT_NEAR(-flight.rotor.p.z(), 30, 0.2);
  EXPECT_LT(flight.position().norm(), 1);

  ASSERT_FALSE(flight.command({Land{{5, 5}, 0, {}}, 10, {}}));
  double touch = 0;
  bool up = true;
  const double time = flight.fly_until_done(60, [&] {
    const bool down = -flight.rotor.p.z() <= 0;
    if (down && up) touch = flight.demand.climb_rate;
    up = !down;
  });
  std::printf("landing took %.1f s\n", time);
  EXPECT_LT(touch, 0);
  EXPECT_GT(touch, -0.6);  // touch_down_sink
  EXPECT_EQ(flight.demand.phase, FlightPhase::kGround);
  EXPECT_LT((flight.position() - Vec2(5, 5)).norm(), 0.2);
  // And up again.
  flight.fly(1);
  ASSERT_FALSE(flight.command({TakeOff{}, 10, {}}));
  flight.fly_until_done(20);
  EXPECT_NEAR(-flight.rotor.p.z(), 10, 1);
}

TEST(MultirotorGuidance, HoldsACourseInTheAirAndAgainstStrongWind) {
  Flight flight({-4, 3});
  ASSERT_FALSE(flight.command({HoldCourse{0}, 50, {}}));
  flight.fly(20);
  // 10 m/s through the air: sqrt(100 - 9) - 4 over ground.
  EXPECT_NEAR(flight.rotor.v.x(), std::sqrt(91) - 4, 0.02);
  EXPECT_NEAR(flight.rotor.v.y(), 0, 0.02);
  EXPECT_FALSE(flight.demand.holds_position);
  flight.rotor.wind = {-11, 0};
  flight.fly(20);
  EXPECT_NEAR(flight.rotor.v.x(), 1, 0.02);  // least over ground, with up to `fastest`
}

TEST(MultirotorGuidance, StopsWithoutTurningBackAfterSomebodyElseFlew) {
  for (const double speed : {0.5, 8.0}) {
    Flight flight;
    flight.fly(1);
    flight.rotor.p = {40, 0, -60};
    flight.rotor.v = {speed, 0, 0};
    flight.guidance.forget(flight.rotor.nav());
    flight.demand = flight.guidance.step(flight.rotor.nav(), PointRotor::kStep);
    EXPECT_LT((flight.demand.position - Vec2(40, 0)).norm(), 0.1);
    double last = 40, back = 0;
    flight.fly(12, [&] {
      back = std::max(back, last - flight.demand.position.x());
      last = std::max(last, flight.demand.position.x());
    });
    EXPECT_LT(back, 0.05);
    EXPECT_LT(flight.rotor.v.norm(), 0.02);
    // 8 m/s are gone within 8^2 / (2 2.1) + 0.5 m, and what the start of braking takes.
    EXPECT_LT(flight.position().x(), 40 + speed * speed / 4.2 + 2);
  }
}

TEST(MultirotorGuidance, TheReferenceWaitsForAVehicleThatCannotFollow) {
  Flight flight;
  ASSERT_FALSE(flight.command({HoldPosition{{300, 0}}, 50, {}}));
  for (int i = 0; i < 2000; ++i)  // held fast
    flight.demand = flight.guidance.step(flight.rotor.nav(), PointRotor::kStep);
  // Twice max_lag, and the distance to brake from 10 m/s: 17 m, of which the first slows
  // it.
  EXPECT_LT(flight.demand.position.x(), 20);
  EXPECT_LT(flight.demand.velocity.norm(), 0.01);
}

TEST(MultirotorGuidance, KeepsItsHeadingWhenAsked) {
  MultirotorGuidanceOptions options;
  options.yaws_along_track = false;
  Flight flight(Vec2::Zero(), options);
  ASSERT_FALSE(flight.command({HoldPosition{{0, -50}}, 50, {}}));
  flight.fly(10);
  EXPECT_EQ(flight.demand.heading, 0);
}

}  // namespace
}  // namespace skein::autopilot::multirotor_guidance_test
