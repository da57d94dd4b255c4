// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/imu_sensor.h"

#include <cmath>

#include "skein/data/vehicle/air.h"
#include "skein/layer/sensory/gauss_markov.h"

namespace skein::sensory {
namespace {

// geo::log_so3, by the series of 2 asin(s)/s where that is exact to rounding: turns below
// 0.1 rad, which is nearly always.
Vec3 rotation_vector(const Quat& q) {
  const double s2 = q.vec().squaredNorm();
  if (s2 > 2.5e-3) return geo::log_so3(q);
  const double s4 = s2 * s2;
  const double scale =
      2 + s2 / 3 + s4 * ((3.0 / 20 + s2 * (5.0 / 56)) + s4 * (35.0 / 576));
  return (q.w() < 0 ? -scale : scale) * q.vec();
}

Vec3 clamped(const Vec3& v, double limit) {
  return v.cwiseMin(limit).cwiseMax(-limit);
}

}  // namespace

ImuSensor::ImuSensor(const ImuOptions& options, std::uint64_t seed, EntityId entity,
                     std::uint32_t instance)
    : PeriodicSensor(options.rate_hz, options.latency),
      options_(options),
      normal_(RandomStream(seed, entity.value, Purpose::kImu, instance)),
      gyro_scale_(options.gyro_scale_sd * normal3(normal_)),
      gyro_bias_(options.gyro_bias_sd * normal3(normal_)),
      accelerometer_scale_(options.accelerometer_scale_sd * normal3(normal_)),
      accelerometer_bias_(options.accelerometer_bias_sd * normal3(normal_)),
      unit_(static_cast<std::uint8_t>(instance)) {}

void ImuSensor::walk(Time now) {
  const double root = std::sqrt((now - walked_).seconds());
  gyro_bias_ += options_.gyro_bias_walk * root * normal3(normal_);
  accelerometer_bias_ += options_.accelerometer_bias_walk * root * normal3(normal_);
  walked_ = now;
}

bool ImuSensor::measure(const SensorView& view, ImuSample& sample) {
  sample.unit = unit_;
  const Quat& q_NB = view.vehicle.q_NB;
  const Vec3& v_N = view.vehicle.v_N;
  const bool whole = started_;
  if (whole) {
    const double dt = (view.now - since_).seconds();
    const Vec3 w = rotation_vector(q_NB_.conjugate() * q_NB) / dt;
    // Half way from q- to q+ lies their sum, once both are on one side.
    const double side = q_NB_.coeffs().dot(q_NB.coeffs()) < 0 ? -1 : 1;
    Quat q_mid(Eigen::Vector4d(q_NB_.coeffs() + side * q_NB.coeffs()));
    q_mid.normalize();
    const Vec3 f = q_mid.conjugate() * ((v_N - v_N_) / dt - Vec3(0, 0, kGravity));
    const double per_root = 1 / std::sqrt(dt);
    sample.interval = dt;
    sample.w_NB_B = clamped(w + gyro_scale_.cwiseProduct(w) + gyro_bias_ +
                                options_.gyro_noise * per_root * normal3(normal_),
                            options_.gyro_range);
    sample.f_B = clamped(f + accelerometer_scale_.cwiseProduct(f) + accelerometer_bias_ +
                             options_.accelerometer_noise * per_root * normal3(normal_),
                         options_.accelerometer_range);
    if ((view.now - walked_).ns() >= 1'000'000'000) walk(view.now);
  } else {
    walked_ = view.now;
  }
  q_NB_ = q_NB;
  v_N_ = v_N;
  since_ = view.now;
  started_ = true;
  return whole;
}

}  // namespace skein::sensory
