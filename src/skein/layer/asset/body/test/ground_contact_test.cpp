// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/body/ground_contact.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::asset::ground_contact_test {
namespace {

constexpr double kStep = 0.01;
constexpr double kGround = 100;

GroundContactParameters wheels() {
  GroundContactParameters p;
  p.speed_limit = 1e9;
  p.friction_along = 0.05;
  p.friction_across = 0.8;
  p.rest_pitch = 0.02;
  p.nose_fall = 1;
  return p;
}

VehicleState at_ground(const Vec3& v_N, const geo::Euler& attitude) {
  VehicleState s;
  s.p_N = {0, 0, -kGround + 0.001};
  s.v_N = v_N;
  s.q_NB = geo::from_euler(attitude);
  return s;
}

// Gravity, less a share of it that wings carry, then the ground: steps until it stands.
double seconds_to_stop(const GroundContactParameters& p, VehicleState& s, double lift) {
  for (int i = 0; i < 100000; ++i) {
    if (s.v_N.head<2>().norm() == 0) return i * kStep;
    s.v_N.z() += (1 - lift) * kGravity * kStep;
    s.p_N += kStep * s.v_N;
    EXPECT_EQ(touch_ground(p, s, kGround, kStep), Contact::kRests);
  }
  return -1;
}

TEST(GroundContact, SlidesToAStopAsFrictionSays) {
  VehicleState s = at_ground({10, 0, 0}, {});
  s.on_ground = true;
  // v / (mu g); gravity's speed of one step comes at its end.
  EXPECT_NEAR(seconds_to_stop(wheels(), s, 0), 10 / (0.05 * kGravity), kStep);
  EXPECT_NEAR(s.p_N.x(), 100 / (2 * 0.05 * kGravity), 10 * kStep);
  EXPECT_EQ(s.p_N.z(), -kGround);
  EXPECT_TRUE(s.on_ground);
}

TEST(GroundContact, BrakesStopIt) {
  GroundContactParameters p = wheels();
  p.brake_friction = 0.3;
  for (const double brake : {0.0, 0.5, 1.0}) {
    VehicleState s = at_ground({8, 0, 0.5}, {0, 0.02, 0});
    s.on_ground = true;
    EXPECT_EQ(touch_ground(p, s, kGround, kStep, brake), Contact::kRests);
    EXPECT_NEAR(s.v_N.x(), 8 - (0.05 + 0.3 * brake) * 0.5, 1e-12);
  }
  VehicleState slow = at_ground({0.1, 0, 0.5}, {0, 0.02, 0});
  touch_ground(p, slow, kGround, kStep, 1);
  EXPECT_EQ(slow.v_N.x(), 0) << "and not backwards";
}

TEST(GroundContact, LiftTakesTheLoadOffTheWheels) {
  VehicleState s = at_ground({10, 0, 0}, {});
  s.on_ground = true;
  EXPECT_NEAR(seconds_to_stop(wheels(), s, 0.5), 10 / (0.5 * 0.05 * kGravity), kStep);
}

TEST(GroundContact, WheelsHoldAcrossAndRollAlong) {
  VehicleState s = at_ground({0, 0, 0.5}, {0, 0.02, 0});
  s.v_N.head<2>() = Vec2(8, 0.3);
  EXPECT_EQ(touch_ground(wheels(), s, kGround, kStep), Contact::kRests);
  EXPECT_NEAR(s.v_N.x(), 8 - 0.05 * 0.5, 1e-12);
  EXPECT_NEAR(s.v_N.y(), 0, 1e-12);
  EXPECT_EQ(s.v_N.z(), 0);
}

TEST(GroundContact, AttitudeDoesNotDependOnHeading) {
  for (const double yaw : {0.0, 1.0, -2.5}) {
    VehicleState s = at_ground({0, 0, 0.5}, {0.1, 0.05, yaw});
    s.v_N.head<2>() = 8 * geo::unit(yaw) + 3 * geo::unit(yaw + geo::kPi / 2);
    touch_ground(wheels(), s, kGround, kStep);
    EXPECT_NEAR(geo::horizontal(s.v_N).dot(geo::unit(yaw)), 8 - 0.025, 1e-12);
    EXPECT_NEAR(geo::horizontal(s.v_N).dot(geo::unit(yaw + geo::kPi / 2)), 3 - 0.4,
                1e-12);
    EXPECT_NEAR(geo::to_euler(s.q_NB).yaw, yaw, 1e-12);
    EXPECT_NEAR(geo::to_euler(s.q_NB).roll, 0.1 * std::exp(-0.1), 1e-12);
  }
}

TEST(GroundContact, HardTiltedOrFastTouchesBreak) {
  const GroundContactParameters feet;
  VehicleState s = at_ground({0, 0, 2.6}, {});
  EXPECT_EQ(touch_ground(feet, s, kGround, kStep), Contact::kCrash);
  s = at_ground({0, 0, 1}, {0.5, 0.5, 0});  // 0.69 from upright
  EXPECT_EQ(touch_ground(feet, s, kGround, kStep), Contact::kCrash);
  s = at_ground({0, 0, 1}, {geo::kPi, 0, 0});
  EXPECT_EQ(touch_ground(feet, s, kGround, kStep), Contact::kCrash);
  s = at_ground({2.5, 2.5, 0.5}, {});
  EXPECT_EQ(touch_ground(feet, s, kGround, kStep), Contact::kCrash);
  s = at_ground({1, 1, 0.5}, {0.1, 0.1, 0});
  EXPECT_EQ(touch_ground(feet, s, kGround, kStep), Contact::kRests);
}

TEST(GroundContact, FeetHoldLevelAndStopTurning) {
  const GroundContactParameters feet;
  VehicleState s = at_ground({0, 0, 0.5}, {0.2, -0.2, 1});
  s.w_NB_B = {1, 1, 3};
  EXPECT_EQ(touch_ground(feet, s, kGround, kStep), Contact::kRests);
  EXPECT_EQ(s.w_NB_B, Vec3(0, 0, 0));  // grip 10 times 0.5 m/s is more than 3 rad/s
  for (int i = 0; i < 100; ++i) touch_ground(feet, s, kGround, kStep);
  const geo::Euler attitude = geo::to_euler(s.q_NB);
  EXPECT_LT(std::abs(attitude.roll), 1e-4);  // 0.2 exp(-10)
  EXPECT_LT(std::abs(attitude.pitch), 1e-4);
}

TEST(GroundContact, TheNoseFallsToRestAndNotBelow) {
  const GroundContactParameters p = wheels();
  VehicleState s = at_ground({5, 0, 0}, {0, 0.15, 0});
  for (int i = 0; i < 300; ++i) {
    s.v_N.z() += kGravity * kStep;
    s.p_N.z() += kStep * s.v_N.z();
    s.q_NB = s.q_NB * geo::exp_so3(kStep * s.w_NB_B);
    touch_ground(p, s, kGround, kStep);
    EXPECT_GT(geo::to_euler(s.q_NB).pitch, 0);
  }
  EXPECT_NEAR(geo::to_euler(s.q_NB).pitch, p.rest_pitch, 1e-3);
  // An elevator that is stronger than the weight on the wheels raises it.
  s.w_NB_B.y() = 1;
  touch_ground(p, s, kGround, kStep);
  EXPECT_EQ(s.w_NB_B.y(), 1);
}

TEST(GroundContact, WheelsSteer) {
  VehicleState s = at_ground({5, 0, 0.2}, {});
  touch_ground(wheels(), s, kGround, kStep, 0, 0.1);
  EXPECT_NEAR(s.w_NB_B.z(), 0.1 * s.v_N.x(), 1e-9);
}

TEST(GroundContact, WhatRisesIsNotHeld) {
  const GroundContactParameters feet;
  VehicleState s = at_ground({0, 0, -0.3}, {});
  EXPECT_EQ(touch_ground(feet, s, kGround, kStep), Contact::kRests);
  EXPECT_EQ(s.v_N.z(), -0.3);
}

TEST(ParameterCheck, InertiaOfNoBodyIsNamed) {
  ParameterCheck check;
  Inertia rod;
  rod.zz = 2.5;
  check.inertia("inertia", rod);
  check.inertia("fine", Inertia{});
  check.above("mass", -1, 0);
  check.within("pitch", std::nan(""), 0, 1);
  const auto found = check.take();
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].key, "inertia");
  EXPECT_EQ(found[1].message, "-1 must be above 0");
  EXPECT_EQ(found[2].message, "nan is no number to fly with");
}

}  // namespace
}  // namespace skein::asset::ground_contact_test
