// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/control/multirotor_control.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>

#include "skein/data/vehicle/air.h"

namespace skein::autopilot::multirotor_control_test {
namespace {

constexpr double kStep = 0.01;

MultirotorAirframe airframe() {
  MultirotorAirframe a;
  a.mass = 1.5;
  a.inertia = Vec3(0.02, 0.02, 0.04);
  for (int k = 0; k < 4; ++k)
    a.rotors.push_back(
        {0.25 * geo::unit(geo::kPi / 4 + geo::kPi / 2 * k), k % 2 == 0 ? 1.0 : -1.0});
  a.thrust_max = 8;
  a.torque_ratio = 0.016;
  a.tilt_limit = 0.6;
  a.cruise = 8;
  a.fastest = 12;
  a.climb_rate = 4;
  a.sink_rate = 3;
  a.motor_lag = 0.05;
  return a;
}

// Torques and thrust of rotors without lag on a rigid body without drag: enough to close
// the cascade. The real plant flies in the tests of assemble.
void fly(NavState& nav, const Actuators& u, double thrust_factor, double dt) {
  const MultirotorAirframe a = airframe();
  double thrust = 0;
  Vec3 torque = Vec3::Zero();
  for (std::size_t k = 0; k < a.rotors.size(); ++k) {
    const double f = thrust_factor * a.thrust_max * u[k] * u[k];
    thrust += f;
    torque += f * Vec3(-a.rotors[k].position.y(), a.rotors[k].position.x(),
                       a.rotors[k].spin * a.torque_ratio);
  }
  const Vec3 w = nav.w_NB_B;
  nav.w_NB_B +=
      dt * (torque - w.cross(a.inertia.cwiseProduct(w))).cwiseQuotient(a.inertia);
  nav.q_NB = nav.q_NB * geo::exp_so3(nav.w_NB_B * dt);
  nav.v_N += dt * (Vec3(0, 0, kGravity) + nav.q_NB * Vec3(0, 0, -thrust / a.mass));
  nav.p_N += dt * nav.v_N;
}

NavState at_rest() {
  NavState nav;
  nav.p_N = Vec3(0, 0, -50);
  return nav;
}

MultirotorDemand hover() {
  MultirotorDemand d;
  d.altitude_msl = 50;
  return d;
}

TEST(MultirotorControl, GoesToAPointWithLittleOvershoot) {
  MultirotorControl control(airframe(), {});
  NavState nav = at_rest();
  MultirotorDemand d = hover();
  d.position = Vec2(5, -3);
  d.altitude_msl = 55;
  d.heading = 2.5;
  double beyond = 0, above = 0;
  for (int k = 0; k < 2000; ++k) {
    fly(nav, control.control(d, nav, kStep), 1, kStep);
    beyond = std::max({beyond, nav.p_N.x() - 5, -nav.p_N.y() - 3});
    above = std::max(above, -nav.p_N.z() - 55);
  }
  EXPECT_LT(beyond, 0.75);  // of 5 m
  EXPECT_LT(above, 0.75);
  EXPECT_LT((nav.p_N - Vec3(5, -3, -55)).norm(), 0.05);
  EXPECT_NEAR(geo::yaw(nav.q_NB), 2.5, 0.01);
}

TEST(MultirotorControl, FollowsAMovingReferenceWithoutLag) {
  MultirotorControl control(airframe(), {});
  NavState nav = at_rest();
  nav.v_N.x() = 6;
  for (int k = 0; k < 1000; ++k) {
    MultirotorDemand d = hover();
    const double t = k * kStep;
    // A circle of 20 m at 6 m/s.
    d.position = 20 * Vec2(std::sin(0.3 * t), 1 - std::cos(0.3 * t));
    d.velocity = 6 * Vec2(std::cos(0.3 * t), std::sin(0.3 * t));
    d.acceleration = 1.8 * Vec2(-std::sin(0.3 * t), std::cos(0.3 * t));
    fly(nav, control.control(d, nav, kStep), 1, kStep);
    if (k > 300) {
      ASSERT_LT((geo::horizontal(nav.p_N) - d.position).norm(), 0.35);
    }
  }
}

TEST(MultirotorControl, RecoversFromUpsideDown) {
  MultirotorControl control(airframe(), {});
  for (const geo::Euler upset : {geo::Euler{geo::kPi, 0, 0}, {0, 1.5, 0}, {2, 0.5, 1}}) {
    NavState nav = at_rest();
    nav.q_NB = geo::from_euler(upset);
    nav.w_NB_B = Vec3(1, -2, 0.5);
    control.reset(nav);
    // It first stops sinking, then goes back to its place, for which it tilts again.
    for (int k = 0; k < 400; ++k)
      fly(nav, control.control(hover(), nav, kStep), 1, kStep);
    EXPECT_GT(geo::down_in_body(nav.q_NB).z(), 0.9);
  }
}

TEST(MultirotorControl, LearnsTheHoverThrust) {
  MultirotorControl control(airframe(), {});
  NavState nav = at_rest();
  for (int k = 0; k < 6000; ++k)
    fly(nav, control.control(hover(), nav, kStep), 0.8, kStep);
  EXPECT_NEAR(-nav.p_N.z(), 50, 0.02);
  EXPECT_NEAR(control.hover_scale(), 1 / 0.8, 0.02);
}

TEST(MultirotorControl, KnowsThatThinAirCarriesLess) {
  // The International Standard Atmosphere at 5,000 m: 0.736 kg/m^3 of 1.225.
  const double share = 0.7364 / 1.225;
  MultirotorControl control(airframe(), {});
  NavState nav = at_rest();
  nav.p_N.z() = -5000;
  MultirotorDemand demand = hover();
  demand.altitude_msl = 5000;
  for (int k = 0; k < 3000; ++k) {
    fly(nav, control.control(demand, nav, kStep), share, kStep);
    ASSERT_NEAR(-nav.p_N.z(), 5000, 0.05) << "from the first step on";
  }
  EXPECT_NEAR(control.hover_scale(), 1, 0.01) << "there is nothing to learn";
}

TEST(MultirotorControl, StabilizesAsTheSticksSay) {
  MultirotorControl control(airframe(), {});
  NavState nav = at_rest();
  PilotInput sticks;
  sticks.roll = 0.5;
  sticks.pitch = -0.25;
  sticks.throttle = 0.5;
  for (int k = 0; k < 300; ++k)
    fly(nav, control.stabilize(control.attitude_for(sticks), nav, kStep), 1, kStep);
  const geo::Euler e = geo::to_euler(nav.q_NB);
  EXPECT_NEAR(e.roll, 0.3, 0.01);
  EXPECT_NEAR(e.pitch, -0.15, 0.01);
  sticks = {};
  sticks.yaw = 0.5;
  sticks.throttle = 0.5;
  for (int k = 0; k < 300; ++k) fly(nav, control.manual(sticks, nav, kStep), 1, kStep);
  EXPECT_NEAR(nav.w_NB_B.z(), 1, 0.05);
  EXPECT_NEAR(nav.w_NB_B.x(), 0, 0.05);
}

TEST(MultirotorControl, StandsOnTheGround) {
  MultirotorControl control(airframe(), {});
  MultirotorDemand d = hover();
  d.phase = FlightPhase::kGround;
  EXPECT_EQ(control.control(d, at_rest(), kStep).channel, Actuators{}.channel);
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

TEST(MultirotorControl, StaysInRangeWhateverHappensAndThenHovers) {
  EXPECT_TRUE(rc::check([] {
    MultirotorControl control(airframe(), {});
    for (int k = 0; k < 20; ++k) {
      NavState nav;
      nav.p_N = Vec3(any_number(), any_number(), any_number());
      nav.v_N = Vec3(any_number(), any_number(), any_number());
      nav.q_NB = Quat(any_number(), any_number(), any_number(), any_number());
      if (*rc::gen::inRange(0, 3) > 0) nav.q_NB.normalize();
      nav.w_NB_B = Vec3(any_number(), any_number(), any_number());
      Actuators u;
      switch (*rc::gen::inRange(0, 4)) {
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
        default: {
          MultirotorDemand d;
          d.position = Vec2(any_number(), any_number());
          d.velocity = Vec2(any_number(), any_number());
          d.acceleration = Vec2(any_number(), any_number());
          d.holds_position = *rc::gen::inRange(0, 2) == 0;
          d.altitude_msl = any_number();
          d.climb_rate = any_number();
          d.heading = any_number();
          u = control.control(d, nav, std::abs(any_number()));
        }
      }
      for (std::size_t c = 0; c < Actuators::kMaxChannels; ++c)
        RC_ASSERT(u[c] >= 0 && u[c] <= 1);
    }
    NavState nav = at_rest();
    control.reset(nav);
    for (int k = 0; k < 3000; ++k)
      fly(nav, control.control(hover(), nav, kStep), 1, kStep);
    RC_ASSERT((nav.p_N - Vec3(0, 0, -50)).norm() < 0.5);
  }));
}

}  // namespace
}  // namespace skein::autopilot::multirotor_control_test
