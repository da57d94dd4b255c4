// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/control/fixed_wing_control.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>

#include "skein/data/vehicle/air.h"

namespace skein::autopilot::fixed_wing_control_test {
namespace {

constexpr double kStep = 0.01;

FixedWingAirframe airframe() {
  FixedWingAirframe a;
  a.mass = 11;
  a.slowest = 17;
  a.cruise = 25;
  a.fastest = 36;
  a.bank_limit = 0.7;
  a.pitch_up = 0.4;
  a.pitch_down = -0.4;
  a.climb_rate = 4;
  a.sink_rate = 3;
  a.trim_alpha = 0.05;
  a.trim_elevator = -0.2;
  a.trim_throttle = 0.5;
  return a;
}

NavState cruising(double roll = 0, double pitch = 0.05) {
  NavState nav;
  nav.p_N = Vec3(0, 0, -100);
  nav.v_N = Vec3(25, 0, 0);
  nav.q_NB = geo::from_euler({roll, pitch, 0});
  nav.airspeed = 25;
  return nav;
}

FixedWingDemand level() {
  FixedWingDemand d;
  d.altitude_msl = 100;
  d.airspeed = 25;
  return d;
}

TEST(FixedWingControl, HoldsTrimInTrim) {
  FixedWingControl control(airframe(), {});
  Actuators u;
  for (int k = 0; k < 1000; ++k) u = control.control(level(), cruising(), kStep);
  EXPECT_NEAR(u[channel::kAileron], 0, 1e-9);
  EXPECT_NEAR(u[channel::kElevator], -0.2, 2e-3);  // stiffness at cos(pitch) g, not g
  EXPECT_NEAR(u[channel::kRudder], 0, 1e-9);
  EXPECT_NEAR(u[channel::kThrottle], 0.5, 1e-2);
}

TEST(FixedWingControl, MovesEverySurfaceInTheRightSense) {
  const auto first = [](const FixedWingDemand& demand, const NavState& nav, int steps) {
    FixedWingControl control(airframe(), {});
    control.reset(cruising());
    Actuators u;
    for (int k = 0; k < steps; ++k) u = control.control(demand, nav, kStep);
    return u;
  };
  FixedWingDemand d = level();
  d.lateral_acceleration = 3;
  EXPECT_GT(first(d, cruising(), 20)[channel::kAileron], 0.01);
  d = level();
  d.altitude_msl = 120;
  const Actuators climb = first(d, cruising(), 50);
  EXPECT_LT(climb[channel::kElevator], -0.21);
  EXPECT_GT(climb[channel::kThrottle], 0.6);
  d = level();
  d.airspeed = 20;
  const Actuators slower = first(d, cruising(), 50);
  EXPECT_LT(slower[channel::kElevator], -0.21);
  EXPECT_LT(slower[channel::kThrottle], 0.4);
  // A nose that swings right is held by left rudder, which is positive.
  NavState swinging = cruising();
  swinging.w_NB_B.z() = 0.2;
  EXPECT_GT(first(level(), swinging, 1)[channel::kRudder], 0.01);
  // In a steady right turn the nose has to be pulled into the turn.
  EXPECT_LT(first(level(), cruising(0.6), 1)[channel::kElevator], -0.25);
}

TEST(FixedWingControl, ServesAirspeedFirstWhenSlow) {
  FixedWingControl control(airframe(), {});
  NavState nav = cruising();
  nav.airspeed = 14;
  nav.v_N.x() = 14;
  control.reset(nav);
  FixedWingDemand d = level();
  d.altitude_msl = 200;  // far above: no reason to climb now
  Actuators u;
  for (int k = 0; k < 200; ++k) u = control.control(d, nav, kStep);
  EXPECT_DOUBLE_EQ(u[channel::kThrottle], 1);
  // Less pull than the same aircraft in trim at that airspeed, where the lift is short.
  FixedWingControl held(airframe(), {});
  Actuators trim;
  for (int k = 0; k < 200; ++k) trim = held.stabilize({0, 0.05, 0, 0.5}, nav, kStep);
  EXPECT_GT(u[channel::kElevator], trim[channel::kElevator]);
}

TEST(FixedWingControl, GlidesWithoutMotor) {
  FixedWingAirframe a = airframe();
  FixedWingControl gliding(a, {});
  FixedWingDemand d = level();
  d.phase = FlightPhase::kGlide;
  Actuators u;
  for (int k = 0; k < 200; ++k) u = gliding.control(d, cruising(), kStep);
  EXPECT_EQ(u[channel::kThrottle], 0);
  a.motor = false;
  FixedWingControl glider(a, {});
  for (int k = 0; k < 200; ++k) u = glider.control(level(), cruising(), kStep);
  EXPECT_EQ(u[channel::kThrottle], 0);
}

TEST(FixedWingControl, KeepsTheRunStraightAndStandsOnTheGround) {
  FixedWingControl control(airframe(), {});
  NavState nav = cruising();
  nav.airspeed = 8;
  nav.v_N = Vec3(8, 0, 0);
  FixedWingDemand d = level();
  d.phase = FlightPhase::kRun;
  Actuators u;
  for (int k = 0; k < 100; ++k) u = control.control(d, nav, kStep);
  EXPECT_DOUBLE_EQ(u[channel::kThrottle], 1);
  EXPECT_NEAR(u[channel::kRudder], 0, 1e-9);
  nav.q_NB = geo::from_euler({0, 0.05, 0.1});  // has swung right: left rudder
  EXPECT_GT(control.control(d, nav, kStep)[channel::kRudder], 0.05);
  d.phase = FlightPhase::kGround;
  EXPECT_EQ(control.control(d, nav, kStep)[channel::kThrottle], 0);
}

TEST(FixedWingControl, RollsOutWithoutLiftAndBrakes) {
  FixedWingAirframe a = airframe();
  a.roll_friction = 0.05;
  a.brake_friction = 0.3;
  FixedWingControl control(a, {});
  NavState nav = cruising();
  nav.airspeed = 18;
  nav.v_N = Vec3(18, 0, 0);
  FixedWingDemand d = level();
  d.phase = FlightPhase::kRollOut;
  d.heading = {1, 0};
  const auto braked = [&](double deceleration) {
    d.braking = deceleration;
    return control.control(d, nav, kStep);
  };
  const Actuators u = braked(2);
  EXPECT_EQ(u[channel::kThrottle], 0);
  EXPECT_NEAR(u[channel::kBrake], (2 / kGravity - 0.05) / 0.3, 1e-9);
  EXPECT_GT(u[channel::kElevator], airframe().trim_elevator) << "nose down";
  EXPECT_EQ(braked(0.1)[channel::kBrake], 0) << "friction does that";
  EXPECT_EQ(braked(100)[channel::kBrake], 1);
  nav.q_NB = geo::from_euler({0, 0.05, 0.1});
  EXPECT_GT(braked(0)[channel::kRudder], 0.05) << "back to the left";
  nav.q_NB = geo::from_euler({0.1, 0.05, 0});
  EXPECT_LT(braked(0)[channel::kAileron], -0.05);
  braked(100);
  EXPECT_EQ(control.control(level(), nav, kStep)[channel::kBrake], 0);
  a.brake_friction = 0;
  FixedWingControl without(a, {});
  EXPECT_EQ(without.control(d, nav, kStep)[channel::kBrake], 0);
}

TEST(FixedWingControl, HoldsItselfDownAtRestInAWind) {
  // At this airspeed a wing in the air would need the nose far up.
  FixedWingControl control(airframe(), {});
  NavState nav = cruising();
  nav.airspeed = 10;
  nav.v_N.setZero();
  nav.wind_N = Vec3(-10, 0, 0);
  FixedWingDemand d = level();
  d.phase = FlightPhase::kGround;
  EXPECT_GT(control.control(d, nav, kStep)[channel::kElevator], airframe().trim_elevator);
}

TEST(FixedWingControl, GivesNoHeightForAirspeedJustOffTheGround) {
  // The airspeed is far below the setpoint: in flight the nose goes down for it.
  const auto elevator = [](FlightPhase phase) {
    FixedWingControl control(airframe(), {});
    NavState nav = cruising(0, 0.08);
    nav.airspeed = 18.5;
    nav.v_N = Vec3(18.5, 0, 0);
    control.reset(nav);
    FixedWingDemand d = level();
    d.phase = phase;
    d.airspeed = 30;
    Actuators u;
    for (int k = 0; k < 100; ++k) u = control.control(d, nav, kStep);
    return u[channel::kElevator];
  };
  EXPECT_LT(elevator(FlightPhase::kClimbOut), elevator(FlightPhase::kGlide) - 0.1);
}

TEST(FixedWingControl, PointsTheNoseAlongTheCourseJustBeforeTheTouch) {
  const auto rudder = [](double airspeed, const Vec2& heading) {
    FixedWingControl control(airframe(), {});
    NavState nav = cruising();
    nav.q_NB = geo::from_euler({0, 0.05, 0.1});
    nav.wind_N = nav.v_N - 25 * geo::from_euler({0, 0, 0.1}).toRotationMatrix().col(0);
    FixedWingDemand d = level();
    d.phase = FlightPhase::kFlare;
    d.airspeed = airspeed;
    d.heading = heading;
    return control.control(d, nav, kStep)[channel::kRudder];
  };
  EXPECT_GT(rudder(0, {1, 0}), 0.3);
  EXPECT_NEAR(rudder(20, {1, 0}), 0, 0.1) << "still with motor";
  EXPECT_NEAR(rudder(0, {0, 0}), 0, 0.1) << "not asked";
  EXPECT_LT(rudder(0, geo::unit(0.2)), -0.3);
}

TEST(FixedWingControl, HoldsAParkedAircraftDownInAWind) {
  FixedWingAirframe a = airframe();
  a.brake_friction = 0.3;
  FixedWingControl control(a, {});
  FixedWingDemand d = level();
  d.phase = FlightPhase::kGround;
  NavState nav = cruising(0.1, 0.1);
  nav.v_N.setZero();
  nav.airspeed = 12;
  const Actuators windy = control.control(d, nav, kStep);
  EXPECT_GT(windy[channel::kElevator], 0.05) << "nose down";
  EXPECT_LT(windy[channel::kAileron], -0.05);
  EXPECT_EQ(windy[channel::kThrottle], 0);
  EXPECT_EQ(windy[channel::kBrake], 1);
  nav.airspeed = 3;
  const Actuators calm = control.control(d, nav, kStep);
  EXPECT_EQ(calm[channel::kElevator], -0.2);
  EXPECT_EQ(calm[channel::kAileron], 0);
  EXPECT_EQ(calm[channel::kBrake], 1);
}

TEST(FixedWingControl, ChangesHandsWithoutAJump) {
  // Flown by the pilot with bank, climb and power; then the law takes over at the same
  // bank, with height and airspeed far away. One step may move a channel by what rates
  // allow, not more.
  FixedWingControl control(airframe(), {});
  NavState nav = cruising(0.3, 0.1);
  nav.v_N.z() = -1;
  Actuators before;
  for (int k = 0; k < 300; ++k)
    before = control.stabilize({0.3, 0.1, 0, 0.8}, nav, kStep);
  FixedWingDemand d = level();
  d.lateral_acceleration = kGravity * std::tan(0.3);
  d.altitude_msl = 300;
  d.airspeed = 32;
  control.reset(nav);
  const Actuators after = control.control(d, nav, kStep);
  EXPECT_NEAR(after[channel::kThrottle], before[channel::kThrottle], 0.02);
  EXPECT_NEAR(after[channel::kElevator], before[channel::kElevator], 0.05);
  EXPECT_NEAR(after[channel::kAileron], before[channel::kAileron], 0.02);
}

TEST(FixedWingControl, HoldsTheLastOutputWhenNumbersFail) {
  FixedWingControl control(airframe(), {});
  const Actuators before = control.control(level(), cruising(), kStep);
  NavState broken = cruising();
  broken.v_N.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(control.control(level(), broken, kStep).channel, before.channel);
  FixedWingDemand demand = level();
  demand.airspeed = std::numeric_limits<double>::infinity();
  EXPECT_EQ(control.control(demand, cruising(), kStep).channel, before.channel);
}

// Any number: small, huge, not finite.
double any_number() {
  const int kind = *rc::gen::inRange(0, 12);
  const double x = 0.001 * *rc::gen::inRange(-60000, 60000);
  if (kind == 0) return std::numeric_limits<double>::quiet_NaN();
  if (kind == 1) return std::numeric_limits<double>::infinity();
  if (kind == 2) return x * 1e300;
  return x;
}

TEST(FixedWingControl, StaysInRangeWhateverHappens) {
  EXPECT_TRUE(rc::check([] {
    FixedWingControl control(airframe(), {});
    for (int k = 0; k < 20; ++k) {
      NavState nav;
      nav.p_N = Vec3(any_number(), any_number(), any_number());
      nav.v_N = Vec3(any_number(), any_number(), any_number());
      nav.q_NB = Quat(any_number(), any_number(), any_number(), any_number());
      if (*rc::gen::inRange(0, 3) > 0) nav.q_NB.normalize();
      nav.w_NB_B = Vec3(any_number(), any_number(), any_number());
      nav.wind_N = Vec3(any_number(), any_number(), any_number());
      nav.airspeed = any_number();
      const auto phase = static_cast<FlightPhase>(*rc::gen::inRange(0, 7));
      Actuators u;
      switch (*rc::gen::inRange(0, 5)) {
        case 0:
          u = control.stabilize({any_number(), any_number(), any_number(), any_number()},
                                nav, kStep);
          break;
        case 1: {
          PilotInput sticks;
          sticks.roll = any_number();
          sticks.pitch = any_number();
          sticks.yaw = any_number();
          sticks.throttle = any_number();
          u = control.manual(sticks, nav, kStep);
          break;
        }
        default:
          u = control.control(
              {any_number(), any_number(), any_number(), any_number(), phase}, nav,
              std::abs(any_number()));
      }
      for (std::size_t c = 0; c < 3; ++c) RC_ASSERT(u[c] >= -1 && u[c] <= 1);
      RC_ASSERT(u[channel::kThrottle] >= 0 && u[channel::kThrottle] <= 1);
    }
    // And recovers: a quiet flight afterwards is flown like any other.
    control.reset(cruising());
    Actuators u;
    for (int k = 0; k < 6000; ++k) u = control.control(level(), cruising(), kStep);
    RC_ASSERT(std::abs(u[channel::kAileron]) < 0.6);
  }));
}

}  // namespace
}  // namespace skein::autopilot::fixed_wing_control_test
