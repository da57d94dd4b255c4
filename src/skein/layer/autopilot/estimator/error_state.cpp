// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/estimator/error_state.h"

namespace skein::autopilot {
namespace {

Vec3 three(const ErrorVector& e, std::size_t at) {
  return {e[at], e[at + 1], e[at + 2]};
}

void put(ErrorVector& e, std::size_t at, const Vec3& v) {
  e[at] = v.x();
  e[at + 1] = v.y();
  e[at + 2] = v.z();
}

}  // namespace

Navigated corrected(const Navigated& x, const ErrorVector& e) {
  Navigated y;
  y.p_N = x.p_N + three(e, error::kPosition);
  y.v_N = x.v_N + three(e, error::kVelocity);
  y.q_NB = (geo::exp_so3(three(e, error::kAttitude)) * x.q_NB).normalized();
  y.gyro_bias = x.gyro_bias + three(e, error::kGyroBias);
  y.accel_bias = x.accel_bias + three(e, error::kAccelBias);
  y.gyro_scale = x.gyro_scale + three(e, error::kGyroScale);
  y.wind_N = x.wind_N + Vec2(e[error::kWind], e[error::kWind + 1]);
  y.gnss_bias = x.gnss_bias + three(e, error::kGnssBias);
  y.baro_bias = x.baro_bias + e[error::kBaroBias];
  y.magnetic_bias = x.magnetic_bias + three(e, error::kMagneticBias);
  y.airspeed_scale = x.airspeed_scale + e[error::kAirspeedScale];
  return y;
}

ErrorVector difference(const Navigated& truth, const Navigated& estimate) {
  ErrorVector e{};
  put(e, error::kPosition, truth.p_N - estimate.p_N);
  put(e, error::kVelocity, truth.v_N - estimate.v_N);
  put(e, error::kAttitude, geo::log_so3(truth.q_NB * estimate.q_NB.conjugate()));
  put(e, error::kGyroBias, truth.gyro_bias - estimate.gyro_bias);
  put(e, error::kAccelBias, truth.accel_bias - estimate.accel_bias);
  put(e, error::kGyroScale, truth.gyro_scale - estimate.gyro_scale);
  e[error::kWind] = truth.wind_N.x() - estimate.wind_N.x();
  e[error::kWind + 1] = truth.wind_N.y() - estimate.wind_N.y();
  put(e, error::kGnssBias, truth.gnss_bias - estimate.gnss_bias);
  e[error::kBaroBias] = truth.baro_bias - estimate.baro_bias;
  put(e, error::kMagneticBias, truth.magnetic_bias - estimate.magnetic_bias);
  e[error::kAirspeedScale] = truth.airspeed_scale - estimate.airspeed_scale;
  return e;
}

}  // namespace skein::autopilot
