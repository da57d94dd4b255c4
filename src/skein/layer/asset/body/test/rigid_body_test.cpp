// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/body/rigid_body.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/base/check.h"

namespace skein::asset::rigid_body_test {
namespace {

// A body whose axes are not principal, so that nothing is tested by symmetry.
const Inertia kSkewed{0.8, 1.1, 1.7, 0.05, 0.12, -0.03};

Motion tumbling() {
  Motion m;
  m.p_N = {10, -20, -300};
  m.v_N = {12, 3, -8};
  m.q_NB = geo::from_euler({0.4, -0.9, 2});
  m.w_NB_B = {2, -3, 1};
  return m;
}

Motion after(const RigidBody& body, Motion m, double duration, int steps,
             const auto& loads_at) {
  for (int i = 0; i < steps; ++i) rk4_step(body, m, duration / steps, loads_at);
  return m;
}

Loads free_flight(const Stage&) {
  return {};
}

TEST(RigidBody, FreeTumblingKeepsMomentumAndEnergyToOrderFour) {
  const RigidBody body(11, kSkewed);
  const Motion begin = tumbling();
  const auto energy = [&](const Motion& m) {
    return 0.5 * m.w_NB_B.dot(body.inertia() * m.w_NB_B) +
           body.mass() * (0.5 * m.v_N.squaredNorm() - kGravity * m.p_N.z());
  };
  const auto momentum = [&](const Motion& m) -> Vec3 {
    return rotation(m.q_NB) * (body.inertia() * m.w_NB_B);
  };
  const auto drift = [&](int steps) {
    const Motion end = after(body, begin, 10, steps, free_flight);
    return std::pair{(momentum(end) - momentum(begin)).norm(),
                     std::abs(energy(end) - energy(begin))};
  };
  // Of 4.1 N m s and 8 J of rotation; ten seconds at 100 Hz are six turns.
  const auto [momentum100, energy100] = drift(1000);
  EXPECT_LT(momentum100, 1e-6);
  EXPECT_LT(energy100, 1e-6);
  // Half the step: a sixteenth of the error or better.
  const auto [momentum20, energy20] = drift(200);
  const auto [momentum40, energy40] = drift(400);
  EXPECT_GT(momentum20 / momentum40, 14);
  EXPECT_GT(energy20 / energy40, 14);
}

TEST(RigidBody, CentreOfGravityFliesAParabolaWhateverTheTumbling) {
  const RigidBody body(11, kSkewed);
  const Motion begin = tumbling();
  const Motion end = after(body, begin, 10, 100, free_flight);
  const Vec3 fall(0, 0, kGravity);
  // RK4 is exact for a parabola: rounding only.
  EXPECT_LT((end.p_N - (begin.p_N + 10 * begin.v_N + 50 * fall)).norm(), 1e-11);
  EXPECT_LT((end.v_N - (begin.v_N + 10 * fall)).norm(), 1e-12);
}

TEST(RigidBody, SpinAboutAPrincipalAxisTurnsAtConstantRate) {
  const RigidBody body(2, {0.1, 0.2, 0.25});
  Motion begin;
  begin.w_NB_B = {0, 0, 3};
  const Motion end = after(body, begin, 4, 4000, free_flight);
  // RK4 of a rotation by 3e-3 rad a step: angle error (w dt)^5/120/2^4 a step.
  EXPECT_NEAR(geo::wrap_pi(geo::to_euler(end.q_NB).yaw - 12), 0, 1e-11);
  EXPECT_LT((end.w_NB_B - begin.w_NB_B).norm(), 1e-13);
}

TEST(RigidBody, SymmetricTopPrecessesAsInTheory) {
  // Torque-free axisymmetric body: the transverse rate turns in B at
  // (Jz - Jx)/Jx w_z.
  const RigidBody body(1, {0.3, 0.3, 0.5});
  Motion begin;
  begin.w_NB_B = {0.5, 0, 4};
  const Motion end = after(body, begin, 5, 5000, free_flight);
  const double angle = (0.5 - 0.3) / 0.3 * 4 * 5;
  EXPECT_NEAR(end.w_NB_B.x(), 0.5 * std::cos(angle), 1e-10);
  EXPECT_NEAR(end.w_NB_B.y(), 0.5 * std::sin(angle), 1e-10);
  EXPECT_NEAR(end.w_NB_B.z(), 4, 1e-13);
}

// Loads that depend on time and on every part of the motion.
struct Stirred {
  double begin, dt;
  Loads operator()(const Stage& s) const {
    const double t = begin + s.halves * dt / 2;
    Loads loads;
    const Vec3 v_B = s.R_NB.transpose() * s.motion.v_N;
    loads.force_B = Vec3(20 * std::sin(3 * t), 4, -60 + 10 * std::cos(t)) - 0.8 * v_B;
    loads.moment_B = Vec3(std::sin(2 * t), 0.3, -std::cos(3 * t)) -
                     0.4 * s.motion.w_NB_B + 0.02 * s.motion.p_N.z() * Vec3(0, 0, 0.1);
    return loads;
  }
};

Motion stirred(int steps) {
  const RigidBody body(11, kSkewed);
  Motion m = tumbling();
  const double dt = 4.0 / steps;
  for (int i = 0; i < steps; ++i) rk4_step(body, m, dt, Stirred{i * dt, dt});
  return m;
}

double distance(const Motion& a, const Motion& b) {
  return (a.p_N - b.p_N).norm() + (a.v_N - b.v_N).norm() +
         geo::log_so3(a.q_NB.conjugate() * b.q_NB).norm() + (a.w_NB_B - b.w_NB_B).norm();
}

TEST(RigidBody, ErrorIsOfOrderFourAlsoWithLoadsThatChangeInTime) {
  const Motion exact = stirred(6400);
  const double e1 = distance(stirred(100), exact);
  const double e2 = distance(stirred(200), exact);
  const double e3 = distance(stirred(400), exact);
  // 2^4 = 16; the next order still shows at the longer step.
  EXPECT_NEAR(std::log2(e1 / e2), 4, 0.25);
  EXPECT_NEAR(std::log2(e2 / e3), 4, 0.15);
}

TEST(RigidBody, AttitudeStaysARotation) {
  const RigidBody body(11, kSkewed);
  const Motion end = after(body, tumbling(), 100, 1000, free_flight);
  EXPECT_NEAR(end.q_NB.norm(), 1, 1e-15);
  const Mat3 R = rotation(end.q_NB);
  EXPECT_LT((R * R.transpose() - Mat3::Identity()).norm(), 1e-15);
  Quat longer = end.q_NB;
  longer.coeffs() *= 1.1;
  EXPECT_LT((rotation(longer) - R).norm(), 1e-15);
}

TEST(Inertia, RefusesWhatNoBodyHas) {
  EXPECT_TRUE(kSkewed.possible());
  EXPECT_TRUE((Inertia{1, 1, 2}).possible());  // a flat plate
  EXPECT_FALSE((Inertia{1, 1, 2.01}).possible());
  EXPECT_FALSE((Inertia{-1, 1, 1}).possible());
  EXPECT_FALSE((Inertia{1, 1, 1, 0, 1.2, 0}).possible());
  EXPECT_FALSE((Inertia{1, std::nan(""), 1}).possible());
  EXPECT_THROW(RigidBody(1, {1, 1, 3}), Bug);
  EXPECT_THROW(RigidBody(0, {}), Bug);
}

}  // namespace
}  // namespace skein::asset::rigid_body_test
