// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/estimator/strapdown.h"

namespace skein::autopilot {
namespace {

// Exp of a small rotation vector, without roots: below 1e-10 up to half a radian.
Quat small_rotation(const Vec3& v) {
  const double n = v.squaredNorm();
  if (n > 0.25) return geo::exp_so3(v);
  const double c = 1 - n / 8 * (1 - n / 48 * (1 - n / 120));
  const double s = 0.5 - n / 48 * (1 - n / 80 * (1 - n / 168));
  return {c, s * v.x(), s * v.y(), s * v.z()};
}

}  // namespace

void strapdown(Navigated& x, Interval& interval, const Vec3& w_B, const Vec3& f_B,
               double dt) {
  const Quat half_turn = small_rotation(0.5 * dt * w_B);
  const Quat q_mid = x.q_NB * half_turn;
  const Mat3 R = q_mid.toRotationMatrix();
  x.q_NB = q_mid * half_turn;
  // One Newton step keeps the length at 1.
  x.q_NB.coeffs() *= 1.5 - 0.5 * x.q_NB.squaredNorm();

  const Vec3 turn = dt * w_B;
  const Vec3 dv = dt * (R * f_B);
  const Vec3 v = x.v_N;
  x.v_N += dv;
  x.v_N.z() += dt * kGravity;
  x.p_N += 0.5 * dt * (v + x.v_N);

  interval.dt += dt;
  for (int i = 0; i < 3; ++i) {
    const auto row = static_cast<std::size_t>(i);
    for (int j = 0; j < 3; ++j) {
      interval.A[row][static_cast<std::size_t>(j)] += dt * R(i, j);
      interval.C[row][static_cast<std::size_t>(j)] += R(i, j) * turn[j];
    }
    interval.s[row] += dv[i];
  }
}

}  // namespace skein::autopilot
