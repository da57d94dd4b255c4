// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/motion_tracker.h"

#include <gtest/gtest.h>

#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"

namespace skein::mixed::motion_tracker_test {
namespace {

Time s(double seconds) {
  return Time::from_seconds(seconds);
}

// On a circle of radius r about the origin, clockwise, at speed v: its motion at t.
VehicleMotion on_circle(double t, double r, double v) {
  const double angle = v / r * t;
  VehicleMotion m;
  m.time = s(t);
  m.p_N = {r * math::cos(angle), r * math::sin(angle), -100};
  m.v_N = {-v * math::sin(angle), v * math::cos(angle), 0};
  m.q_NB = geo::from_euler({math::atan(v * v / (r * kGravity)), 0, angle + geo::kPi / 2});
  m.position_sd = 1;
  m.altitude_sd = 2;
  return m;
}

TEST(MotionTracker, CarriesACoordinatedTurnOn) {
  MotionTracker tracker(true);
  tracker.add(on_circle(3, 80, 20));
  for (const double age : {0.0, 0.1, 0.5, 1.0, 1.5}) {
    const VehicleMotion now = tracker.at(s(3 + age)), truth = on_circle(3 + age, 80, 20);
    EXPECT_LT((now.p_N - truth.p_N).norm(), 1e-6) << age;
    EXPECT_LT((now.v_N - truth.v_N).norm(), 1e-6) << age;
    EXPECT_NEAR(geo::wrap_pi(geo::yaw(now.q_NB) - geo::yaw(truth.q_NB)), 0, 1e-9);
  }
}

TEST(MotionTracker, GoesStraightWhereABankIsNoTurn) {
  MotionTracker tracker(false);
  VehicleMotion m = on_circle(3, 80, 20);
  m.v_N.z() = 2;
  tracker.add(m);
  EXPECT_LT((tracker.at(s(5)).p_N - (m.p_N + 2 * m.v_N)).norm(), 1e-9);
}

TEST(MotionTracker, BelievesNoTurnForLong) {
  MotionTracker tracker(true);
  tracker.add(on_circle(0, 80, 20));
  const VehicleMotion a = tracker.at(s(1.5)), b = tracker.at(s(4));
  EXPECT_LT((b.p_N - (a.p_N + 2.5 * a.v_N)).norm(), 1e-6);
}

TEST(MotionTracker, KnowsLessWithAge) {
  MotionTracker tracker(true);
  EXPECT_FALSE(tracker.known());
  tracker.add(on_circle(10, 80, 20));
  EXPECT_NEAR(tracker.at(s(10)).position_sd, 1, 1e-12);
  EXPECT_NEAR(tracker.at(s(10)).altitude_sd, 2, 1e-12);
  EXPECT_GT(tracker.at(s(12)).position_sd, 4);
  EXPECT_GT(tracker.at(s(12)).altitude_sd, 4);
}

TEST(MotionTracker, PassesOverWhatComesLate) {
  MotionTracker tracker(true);
  tracker.add(on_circle(10, 80, 20));
  tracker.add(on_circle(9, 80, 20));
  EXPECT_EQ(tracker.time(), s(10));
}

}  // namespace
}  // namespace skein::mixed::motion_tracker_test
