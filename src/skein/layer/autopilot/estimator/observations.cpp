// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/estimator/observations.h"

#include <algorithm>

#include "skein/base/math.h"

namespace skein::autopilot {
namespace {

void add_three(SparseRow& row, std::size_t at, const Vec3& v) {
  for (int k = 0; k < 3; ++k) row.add(at + static_cast<std::size_t>(k), v[k]);
}

// Gradient of (theta x u) along an axis with respect to theta.
void add_cross(SparseRow& row, int axis, const Vec3& u, double scale) {
  const int next = (axis + 1) % 3, last = (axis + 2) % 3;
  row.add(error::kAttitude + static_cast<std::size_t>(next), scale * u[last]);
  row.add(error::kAttitude + static_cast<std::size_t>(last), -scale * u[next]);
}

Vec3 through_air(const Navigated& x) {
  return {x.v_N.x() - x.wind_N.x(), x.v_N.y() - x.wind_N.y(), x.v_N.z()};
}

}  // namespace

// The error back then, from the one now, with s what was gained over the delay d:
//
//   dv(t) = dv - theta x s + d R b_accel
//   dp(t) = dp - d dv + d/2 theta x s - d^2/2 R b_accel
//
// Without the bias in it, what tilt and bias do together would seem to differ from what
// each has done to the velocity. The gyros' bias is left out: it is d smaller.
Observation observe_position(const Navigated& x, const Past& past, int axis) {
  const auto k = static_cast<std::size_t>(axis);
  const double d = past.delay;
  Observation z;
  z.value = past.p_N[axis] + x.gnss_bias[axis];
  z.row.add(error::kGnssBias + k, 1);
  add_three(z.row, error::kAccelBias,
            -0.5 * d * d * x.q_NB.toRotationMatrix().row(axis).transpose());
  add_cross(z.row, axis, past.gained, 0.5 * d);
  z.row.add(error::kVelocity + k, -d);
  z.row.add(error::kPosition + k, 1);
  return z;
}

Observation observe_velocity(const Navigated& x, const Past& past, int axis) {
  Observation z;
  z.value = past.v_N[axis];
  add_three(z.row, error::kAccelBias,
            past.delay * x.q_NB.toRotationMatrix().row(axis).transpose());
  add_cross(z.row, axis, past.gained, -1);
  z.row.add(error::kVelocity + static_cast<std::size_t>(axis), 1);
  return z;
}

Observation observe_altitude(const Navigated& x) {
  Observation z;
  z.value = x.baro_bias - x.p_N.z();
  z.row.add(error::kBaroBias, 1);
  z.row.add(error::kPosition + 2, -1);
  return z;
}

Observation observe_bearing(const Navigated& x, const Vec3& field_N) {
  const Vec3& m = field_N;
  const double level2 = m.x() * m.x() + m.y() * m.y();
  Observation z;
  z.value = math::atan2(m.y(), m.x());
  const Vec3 slope(-m.y() / level2, m.x() / level2, 0);
  add_three(z.row, error::kMagneticBias, x.q_NB.conjugate() * slope);
  z.row.add(error::kAttitude, m.x() * m.z() / level2);
  z.row.add(error::kAttitude + 1, m.y() * m.z() / level2);
  z.row.add(error::kAttitude + 2, -1);
  return z;
}

Observation observe_airspeed(const Navigated& x) {
  const Vec3 air = through_air(x);
  Observation z;
  const double speed = air.norm();
  z.value = (1 + x.airspeed_scale) * speed;
  const Vec3 u = (1 + x.airspeed_scale) / std::max(speed, 1e-3) * air;
  z.row.add(error::kAirspeedScale, speed);
  z.row.add(error::kWind, -u.x());
  z.row.add(error::kWind + 1, -u.y());
  add_three(z.row, error::kVelocity, u);
  return z;
}

Observation observe_airspeed_ahead(const Navigated& x) {
  const Vec3 air = through_air(x);
  const Vec3 ahead = x.q_NB.toRotationMatrix().col(0);
  const double gain = 1 + x.airspeed_scale;
  Observation z;
  z.value = gain * ahead.dot(air);
  z.row.add(error::kAirspeedScale, ahead.dot(air));
  z.row.add(error::kWind, -gain * ahead.x());
  z.row.add(error::kWind + 1, -gain * ahead.y());
  add_three(z.row, error::kVelocity, gain * ahead);
  return z;
}

Observation observe_sideslip(const Navigated& x) {
  const Vec3 air = through_air(x);
  const Vec3 right = x.q_NB.toRotationMatrix().col(1);
  Observation z;
  z.value = right.dot(air);
  z.row.add(error::kWind, -right.x());
  z.row.add(error::kWind + 1, -right.y());
  // (theta x right) . air = theta . (right x air)
  add_three(z.row, error::kAttitude, right.cross(air));
  add_three(z.row, error::kVelocity, right);
  return z;
}

Observation observe_wind(const Navigated& x, int axis) {
  const auto k = static_cast<std::size_t>(axis);
  Observation z;
  z.value = x.wind_N[axis];
  z.row.add(error::kWind + k, 1);
  add_cross(z.row, axis, through_air(x), 1);
  z.row.add(error::kVelocity + k, -1);
  return z;
}

}  // namespace skein::autopilot
