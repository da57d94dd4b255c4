// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/guidance/unflyable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "skein/base/math.h"

namespace skein::autopilot::unflyable_test {
namespace {

const FlightLimits kWing{20, 60, 3, 15, 25, 3};
const FlightLimits kRotor{10, 1, 4, 0, 15, 3};
const Vec2 kCalm = Vec2::Zero();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool says(const AutopilotCommand& command, const std::string& part,
          const Vec2& wind = kCalm, const FlightLimits& limits = kWing) {
  const auto reason = unflyable(command, limits, wind);
  if (!reason) return false;
  EXPECT_NE(reason->find(part), std::string::npos) << *reason;
  return reason->find(part) != std::string::npos;
}

Path turn(double course, double angle, double radius) {
  return {{{0, 0}, course, std::abs(angle) * radius, std::copysign(1 / radius, angle)}};
}

Plan plan(std::initializer_list<double> seconds, const Vec3& v) {
  Plan out;
  for (const double t : seconds) out.push_back({Time::from_seconds(t), t * v, v});
  return out;
}

TEST(Unflyable, NumbersMustBeFinite) {
  EXPECT_TRUE(says({HoldCourse{kNan}, 100, {}}, "course is not finite"));
  EXPECT_TRUE(says({HoldCourse{0}, kNan, {}}, "altitude is not finite"));
  EXPECT_TRUE(says({HoldCourse{0}, 100, kNan}, "airspeed"));
  EXPECT_TRUE(says({HoldPosition{{math::kInfinity, 0}}, 100, {}}, "point is not finite"));
  EXPECT_TRUE(says({Circle{{0, 0}, kNan, true}, 100, {}}, "circle is not finite"));
  EXPECT_TRUE(says({FollowPath{{{{0, kNan}, 0, 1, 0}}}, 100, {}}, "element 1"));
  EXPECT_TRUE(says({FollowPlan{plan({0, 1}, {kNan, 0, 0})}, 0, {}}, "point 1"));
  EXPECT_TRUE(says({FlyWaypoints{{{{0, 0}, kNan}}, 1}, 0, {}}, "waypoint 1"));
  EXPECT_TRUE(says({TakeOff{kNan}, 100, {}}, "not finite"));
  EXPECT_TRUE(says({Land{{0, 0}, kNan, {}}, 100, {}}, "not finite"));
}

TEST(Unflyable, AirspeedIsBounded) {
  EXPECT_TRUE(says({HoldCourse{0}, 100, 10.0}, "from 15.0 to 25.0"));
  EXPECT_TRUE(says({HoldCourse{0}, 100, 30.0}, "from 15.0 to 25.0"));
  EXPECT_FALSE(unflyable({HoldCourse{0}, 100, 18.0}, kWing, kCalm));
}

TEST(Unflyable, TheAirAtAnAltitudeMustCarry) {
  FlightLimits wing = kWing;
  // The slowest airspeed, 15 m/s at sea level, is the fastest, 25 m/s, where the density
  // is 1.225 (15/25)^2 = 0.441 kg/m^3: at 9,475 m of the standard atmosphere.
  wing.min_density = 1.225 * 0.36;
  EXPECT_TRUE(says({HoldCourse{0}, 20000, 24.0}, "9475 m is the maximum", kCalm, wing));
  EXPECT_TRUE(says({HoldCourse{0}, 9480, 25.0}, "commanded altitude", kCalm, wing));
  EXPECT_FALSE(unflyable({HoldCourse{0}, 9470, 25.0}, wing, kCalm));
  // At 8,000 m 15 m/s are 22.9 m/s, more than cruise.
  EXPECT_TRUE(says({HoldCourse{0}, 8000, {}}, "carries from 22.9 m/s on", kCalm, wing));
  EXPECT_FALSE(unflyable({HoldCourse{0}, 8000, 23.0}, wing, kCalm));
  EXPECT_FALSE(unflyable({HoldCourse{0}, 4000, {}}, wing, kCalm));
  EXPECT_TRUE(says({FlyWaypoints{{{{0, 0}, 100}, {{1e6, 0}, 20000}}, 1}, 0, {}},
                   "altitude of waypoint 2", kCalm, wing));
  Plan high = plan({0, 10}, {20, 0, 0});
  for (PlanPoint& point : high) point.p_N.z() = -20000;
  EXPECT_TRUE(
      says({FollowPlan{high}, 0, {}}, "altitude of the plan at 0.0 s", kCalm, wing));

  FlightLimits rotor = kRotor;
  rotor.min_density = 0.6;
  EXPECT_TRUE(says({HoldPosition{{0, 0}}, 20000, {}}, "too thin", kCalm, rotor));
  EXPECT_FALSE(unflyable({HoldPosition{{0, 0}}, 5000, {}}, rotor, kCalm));
  // What needs no air to fly has no ceiling.
  EXPECT_FALSE(unflyable({HoldCourse{0}, 20000, {}}, kWing, kCalm));
}

TEST(Unflyable, TurnsAreHeldAgainstTheSlowestAirspeedInTheWind) {
  // a_max = 20^2 / 60; calm: 15^2 / a_max = 33.75 m.
  EXPECT_FALSE(unflyable({FollowPath{turn(0, 1, 34)}, 100, {}}, kWing, kCalm));
  EXPECT_TRUE(says({FollowPath{turn(0, 1, 33)}, 100, {}}, "34 m is the minimum"));
  // A half turn that ends downwind in 5 m/s: 20^2 / a_max = 60 m.
  EXPECT_FALSE(
      unflyable({FollowPath{turn(geo::kPi, geo::kPi, 61)}, 100, {}}, kWing, {5, 0}));
  EXPECT_TRUE(says({FollowPath{turn(geo::kPi, geo::kPi, 59)}, 100, {}},
                   "60 m is the minimum", {5, 0}));
  // A short turn about upwind: 10^2 / a_max = 15 m, left or right.
  for (const double angle : {-0.2, 0.2})
    EXPECT_FALSE(unflyable({FollowPath{turn(geo::kPi - angle / 2, angle, 17)}, 100, {}},
                           kWing, {5, 0}));
  EXPECT_FALSE(unflyable({Circle{{0, 0}, 61, false}, 100, {}}, kWing, {0, 5}));
  EXPECT_TRUE(says({Circle{{0, 0}, 59, false}, 100, {}}, "60 m is the minimum", {0, 5}));
  EXPECT_TRUE(says({Circle{{0, 0}, 0, false}, 100, {}}, "no radius"));
  EXPECT_TRUE(says({Circle{{0, 0}, -50, false}, 100, {}}, "no radius"));
}

TEST(Unflyable, WhatHoversTurnsOnTheSpot) {
  EXPECT_FALSE(unflyable({FollowPath{turn(0, 3, 0.5)}, 100, {}}, kRotor, {5, 0}));
  EXPECT_FALSE(unflyable({Circle{{0, 0}, 1, true}, 100, {}}, kRotor, kCalm));
  EXPECT_FALSE(
      unflyable({FollowPlan{plan({0, 1, 2}, Vec3::Zero())}, 0, {}}, kRotor, kCalm));
}

TEST(Unflyable, ACourseNeedsMoreAirspeedThanWind) {
  EXPECT_FALSE(unflyable({HoldCourse{0}, 100, {}}, kWing, {-24, 0}));
  EXPECT_TRUE(says({HoldCourse{0}, 100, {}}, "cannot be made good", {-26, 0}));
  EXPECT_TRUE(says({HoldCourse{0}, 100, {}}, "cannot be made good", {0, 26}));
  EXPECT_FALSE(unflyable({HoldCourse{0}, 100, {}}, kWing, {26, 0}));
  EXPECT_TRUE(says({Land{{0, 0}, 0, 0.0}, 100, {}}, "cannot be made good", {-26, 0}));
}

TEST(Unflyable, PlansMustFitTheAircraft) {
  EXPECT_TRUE(says({FollowPlan{}, 0, {}}, "empty"));
  EXPECT_TRUE(says({FollowPlan{plan({0, 2, 2}, {20, 0, 0})}, 0, {}}, "point 3"));
  EXPECT_TRUE(says({FollowPlan{plan({0, 2, 1}, {20, 0, 0})}, 0, {}}, "not later"));
  EXPECT_FALSE(unflyable({FollowPlan{plan({0, 10}, {20, 0, -2})}, 0, {}}, kWing, kCalm));
  // Too slow, too fast; the wind moves both bounds.
  EXPECT_TRUE(says({FollowPlan{plan({0, 10}, {12, 0, 0})}, 0, {}}, "airspeed of 12.0"));
  EXPECT_FALSE(unflyable({FollowPlan{plan({0, 10}, {12, 0, 0})}, 0, {}}, kWing, {-5, 0}));
  EXPECT_TRUE(says({FollowPlan{plan({0, 10}, {28, 0, 0})}, 0, {}}, "airspeed of 28.0"));
  EXPECT_FALSE(unflyable({FollowPlan{plan({0, 10}, {28, 0, 0})}, 0, {}}, kWing, {5, 0}));
  EXPECT_TRUE(says({FollowPlan{plan({0, 10}, {20, 0, -4})}, 0, {}}, "climbs at 4.0"));
  EXPECT_TRUE(says({FollowPlan{plan({0, 10}, {20, 0, 4})}, 0, {}}, "sinks at 4.0"));
  EXPECT_TRUE(says({FollowPlan{plan({0, 10}, {1e200, 0, 0})}, 0, {}}, "not finite", kCalm,
                   kRotor));
}

TEST(Unflyable, PlansMustNotTurnTooTightly) {
  // Circles of 16 points at 16 m/s over ground, whose Hermite curve is a circle within
  // 0.1 % in curvature at the points: 16^2 / a_max = 38.4 m is the minimum.
  const auto round = [](double radius) {
    Plan out;
    for (int i = 0; i <= 16; ++i) {
      const double angle = i * geo::kPi / 8;
      const Vec2 out_N = geo::unit(angle), along = 16 * geo::turned_right(out_N);
      out.push_back({Time::from_seconds(angle * radius / 16),
                     {radius * out_N.x(), radius * out_N.y(), -100},
                     {along.x(), along.y(), 0}});
    }
    return out;
  };
  EXPECT_TRUE(says({FollowPlan{round(36)}, 0, {}}, "38 m is the minimum"));
  EXPECT_FALSE(unflyable({FollowPlan{round(40)}, 0, {}}, kWing, kCalm));
}

TEST(Unflyable, CornersOfPlansAreTurnsOfASecond) {
  // Straight on, and after a millisecond on another course: flown by cutting the
  // corner where the turn could be flown in a second (a_max / V = 0.33 rad), else not.
  const auto corner = [](double angle) {
    const Vec2 on = 20 * geo::unit(0), turned = 20 * geo::unit(angle);
    const Vec2 there = 5 * on, end = there + 5 * turned;
    return Plan{
        {Time::from_seconds(0), {0, 0, -100}, {on.x(), on.y(), 0}},
        {Time::from_seconds(4.999),
         {there.x() - 0.02, there.y(), -100},
         {on.x(), on.y(), 0}},
        {Time::from_seconds(5),
         {there.x(), there.y(), -100},
         {turned.x(), turned.y(), 0}},
        {Time::from_seconds(10), {end.x(), end.y(), -100}, {turned.x(), turned.y(), 0}}};
  };
  EXPECT_FALSE(unflyable({FollowPlan{corner(0.25)}, 0, {}}, kWing, kCalm));
  EXPECT_TRUE(says({FollowPlan{corner(0.5)}, 0, {}}, "turns with a radius"));
}

TEST(Unflyable, ClimbsOfPlansCountOverASecond) {
  // Level but for two points a hundredth of a second apart, of which one is rounded.
  const auto step = [](double up) {
    return Plan{{Time::from_seconds(0), {0, 0, -100}, {20, 0, 0}},
                {Time::from_seconds(4.99), {99.8, 0, -100}, {20, 0, 0}},
                {Time::from_seconds(5), {100, 0, -100 - up}, {20, 0, 0}},
                {Time::from_seconds(10), {200, 0, -100 - up}, {20, 0, 0}}};
  };
  EXPECT_FALSE(unflyable({FollowPlan{step(0.04)}, 0, {}}, kWing, kCalm));
  EXPECT_TRUE(unflyable({FollowPlan{step(20)}, 0, {}}, kWing, kCalm));
}

TEST(Unflyable, WaypointsMustNotBeTooSteep) {
  EXPECT_TRUE(says({FlyWaypoints{}, 0, {}}, "no waypoints"));
  EXPECT_TRUE(says({FlyWaypoints{{{{0, 0}, 100}}, 0}, 0, {}}, "0 laps"));
  // 15 m/s: 3 m/s of climb are 20 m over 100 m, the tenth of slack 22 m.
  const auto legs = [](double rise, int laps) {
    return AutopilotCommand{
        FlyWaypoints{{{{0, 0}, 100}, {{100, 0}, 100 + rise}}, laps}, 0, {}};
  };
  EXPECT_FALSE(unflyable(legs(21, 1), kWing, kCalm));
  EXPECT_TRUE(says(legs(25, 1), "the leg to waypoint 2 climbs"));
  EXPECT_TRUE(says(legs(-25, 1), "sinks"));
  // With laps there is a leg back too.
  EXPECT_FALSE(unflyable(legs(-21, 2), kWing, kCalm));
  EXPECT_TRUE(
      says({FlyWaypoints{{{{0, 0}, 0}, {{500, 0}, 60}, {{100, 0}, 60}}, 2}, 0, {}},
           "the leg to waypoint 1 sinks"));
  EXPECT_FALSE(
      unflyable({FlyWaypoints{{{{0, 0}, 0}, {{500, 0}, 60}, {{100, 0}, 60}}, 1}, 0, {}},
                kWing, kCalm));
  EXPECT_TRUE(says({FlyWaypoints{{{{5, 0}, 0}, {{5, 0}, 60}}, 1}, 0, {}}, "straight up"));
  EXPECT_TRUE(says({FlyWaypoints{{{{5, 0}, 0}, {{5, 0}, 60}}, 1}, 0, {}}, "straight up",
                   kCalm, kRotor));
}

}  // namespace
}  // namespace skein::autopilot::unflyable_test
