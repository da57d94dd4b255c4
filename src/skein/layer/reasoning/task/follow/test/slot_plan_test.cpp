// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/follow/slot_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/model/path/plan_curve.h"

namespace skein::reasoning::slot_plan_test {
namespace {

NavEstimate nav(double time, const Vec3& p, const Vec3& v) {
  NavEstimate n;
  n.time = Time::from_seconds(time);
  n.p_N = p;
  n.v_N = v;
  n.heading = geo::bearing(geo::horizontal(v));
  return n;
}

TEST(Slot, MovesWithTheLeaderAndTurnsWithItsCourse) {
  const LeaderMotion leader{nav(10, {100, 0, -200}, {20, 0, -1}), 0};
  const PlanPoint straight = slot_at(leader, {-30, 20}, 2);
  EXPECT_EQ(straight.time, Time::from_seconds(12));
  EXPECT_LT((straight.p_N - Vec3(110, 20, -202)).norm(), 1e-9);
  EXPECT_EQ(slot_at(leader, {-30, 20}, 6).p_N.z(), -202) << "a climb of two seconds";

  // A quarter turn to the right in 10 s: radius 20 / (pi/20).
  const double rate = geo::kPi / 20, radius = 20 / rate;
  const LeaderMotion turning{leader.at, rate};
  const PlanPoint turned = slot_at(turning, {-30, 20}, 10);
  EXPECT_NEAR(turned.p_N.x(), 100 + radius - 20, 1e-9);
  EXPECT_NEAR(turned.p_N.y(), radius - 30, 1e-9);
  // Then straight on: no more than a quarter turn is foretold.
  const Vec3 on = slot_at(turning, {-30, 20}, 12).p_N - turned.p_N;
  EXPECT_NEAR(on.x(), 0, 1e-9);
  EXPECT_NEAR(on.y(), 40, 1e-9);

  // The velocity is the derivative of the position, in the turn and after it.
  for (const double at : {3.0, 11.0}) {
    const double h = 1e-5;
    const Vec3 difference = (slot_at(turning, {-30, 20}, at + h).p_N -
                             slot_at(turning, {-30, 20}, at - h).p_N) /
                            (2 * h);
    EXPECT_LT((difference - slot_at(turning, {-30, 20}, at).v_N).norm(), 1e-5) << at;
  }
}

FlightLimits small_plane() {
  FlightLimits limits;
  limits.airspeed = 15;
  limits.turn_radius = 32;
  limits.slowest = 11;
  limits.fastest = 20;
  return limits;
}

// Whatever the follower and its leader do, and the wind: speeds, turns and climbs of the
// curve through the plan are those of the aircraft.
TEST(SlotPlan, CanBeFlownWhereverTheFollowerAndItsLeaderAre) {
  const FlightLimits limits = small_plane();
  const double max_lateral = limits.airspeed * limits.airspeed / limits.turn_radius;
  for (const double wind : {0.0, 4.0, 8.0})
    for (const double rate : {-0.6, -0.1, 0.0, 0.3, 0.6})
      for (const double course : {0.0, 1.0, 2.5, 3.1, -1.6})
        for (const Vec3& place :
             {Vec3(0, 0, -100), Vec3(300, 40, -150), Vec3(-90, -9, -60)})
          for (const double speed : {5.0, 15.0, 27.0}) {
            const Vec2 v = speed * geo::unit(course);
            NavEstimate own = nav(1.2, place, {v.x(), v.y(), 4});
            own.wind_N = {0, wind};
            const LeaderMotion leader{nav(0.2, {0, 0, -120}, {15, wind, 1}), rate};
            const Plan plan = plan_to_slot(own, leader, {-40, 40}, limits, 8);
            ASSERT_EQ(plan.size(), 17u);
            EXPECT_EQ(plan.front().time, own.time);
            EXPECT_EQ(plan.front().p_N, own.p_N);
            model::PlanCurve curve;
            curve.assign(plan);
            for (double t = 1.2; t <= 9.2; t += 0.05) {
              const auto at = curve.at(t);
              const Vec2 ground = geo::horizontal(at.v_N), air = ground - own.wind_N;
              const double airspeed = std::hypot(air.norm(), at.v_N.z());
              // As far beyond the limits as autopilots let plans be.
              ASSERT_LT(airspeed, 1.03 * limits.fastest) << t;
              ASSERT_GT(airspeed, 0.97 * limits.slowest) << t;
              ASSERT_LT(std::abs(at.v_N.z()), 1.1 * limits.climb_rate);
              if (ground.norm() < 1) continue;
              const double lateral =
                  std::abs(geo::cross(ground, geo::horizontal(at.a_N))) / ground.norm();
              const double cosine = ground.dot(air) / ground.norm() / air.norm();
              ASSERT_LE(lateral, max_lateral * cosine * 1.01) << t << " wind " << wind;
            }
          }
}

// Flown plan after plan, as a perfect aircraft would.
double away_after(double seconds, const Vec3& start, const FlightLimits& limits,
                  const Vec2& wind) {
  NavEstimate own = nav(0, start, {15, 0, 0});
  own.wind_N = wind;
  const Vec2 offset(-40, 30);
  for (int k = 0; k < seconds; ++k) {
    const LeaderMotion leader{nav(k, {14.0 * k, 2.0 * k, -100}, {14, 2, 0}), 0};
    const Plan plan = plan_to_slot(own, leader, offset, limits, 8);
    own.time = Time::from_seconds(k + 1);
    own.p_N = plan.at(2).p_N;
    own.v_N = plan.at(2).v_N;
  }
  const LeaderMotion leader{nav(seconds, {14 * seconds, 2 * seconds, -100}, {14, 2, 0}),
                            0};
  return (slot_at(leader, offset, 0).p_N - own.p_N).norm();
}

TEST(SlotPlan, LeadsBackIntoTheSlotFromBehindAheadAndBeside) {
  FlightLimits hovering = small_plane();
  hovering.slowest = 0;
  for (const FlightLimits& limits : {small_plane(), hovering})
    for (const Vec3& start : {Vec3(-150, 30, -100), Vec3(20, 30, -90),
                              Vec3(-40, -80, -110), Vec3(-40, 150, -100)})
      EXPECT_LT(away_after(80, start, limits, {0, 3}), 1)
          << start.transpose() << " slowest " << limits.slowest;
}

}  // namespace
}  // namespace skein::reasoning::slot_plan_test
