// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/motion_predictor.h"

#include <gtest/gtest.h>

namespace skein::mixed::motion_predictor_test {
namespace {

Time at_s(double seconds) {
  return Time::from_seconds(seconds);
}

// Even acceleration, and an even turn about the body's axes.
VehicleMotion thrown(double t) {
  const Vec3 v(20, -3, 1), a(1, 2, -4), w(0.3, -0.2, 0.5);
  VehicleMotion m;
  m.time = at_s(t);
  m.p_N = t * v + t * t / 2 * a;
  m.v_N = v + t * a;
  m.w_NB_B = w;
  m.q_NB = geo::exp_so3(t * w);
  return m;
}

TEST(MotionPredictor, CarriesOnWithAccelerationAndRates) {
  MotionPredictor predictor;
  EXPECT_FALSE(predictor.known());
  predictor.add(thrown(1));
  predictor.add(thrown(1.02));
  for (const double age : {-0.01, 0.0, 0.02, 0.2}) {
    const VehicleMotion now = predictor.at(at_s(1.02 + age)), truth = thrown(1.02 + age);
    EXPECT_LT((now.p_N - truth.p_N).norm(), 1e-9) << age;
    EXPECT_LT((now.v_N - truth.v_N).norm(), 1e-9) << age;
    EXPECT_LT(now.q_NB.angularDistance(truth.q_NB), 1e-9) << age;
  }
}

TEST(MotionPredictor, BelievesNothingForLong) {
  MotionPredictor predictor;
  predictor.add(thrown(1));
  predictor.add(thrown(1.02));
  EXPECT_EQ(predictor.at(at_s(9)).p_N, predictor.at(at_s(1.22)).p_N);
}

TEST(MotionPredictor, TakesNoAccelerationFromAJumpOrOverAGap) {
  for (const double gap : {0.02, 2.0}) {
    MotionPredictor predictor;
    predictor.add(thrown(1));
    VehicleMotion next = thrown(1 + gap);
    if (gap < 1) next.v_N.x() += 30;
    predictor.add(next);
    EXPECT_EQ(predictor.at(next.time + at_s(0.1)).v_N, next.v_N) << gap;
  }
}

}  // namespace
}  // namespace skein::mixed::motion_predictor_test
