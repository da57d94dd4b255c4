// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/layer/sensory/periodic_sensor.h"

namespace skein::sensory {

/// The defaults are those of a consumer MEMS unit on a small airframe.
struct ImuOptions {
  double rate_hz = 100;      ///< samples per second; at most one per step of the vehicle
  double latency = 0;        ///< [s]
  double gyro_noise = 2e-4;  ///< white, density [rad/s/sqrt(Hz)]
  double gyro_bias_sd = 5e-3;             ///< of the constant bias per axis [rad/s]
  double gyro_bias_walk = 2e-5;           ///< random walk of the bias [rad/s/sqrt(s)]
  double gyro_scale_sd = 3e-3;            ///< of the relative scale error per axis [-]
  double gyro_range = 35;                 ///< it saturates beyond [rad/s]
  double accelerometer_noise = 4e-3;      ///< white, density [m/s^2/sqrt(Hz)]
  double accelerometer_bias_sd = 0.1;     ///< of the constant bias per axis [m/s^2]
  double accelerometer_bias_walk = 5e-4;  ///< random walk of the bias [m/s^2/sqrt(s)]
  double accelerometer_scale_sd = 3e-3;   ///< of the relative scale error per axis [-]
  double accelerometer_range = 157;       ///< it saturates beyond [m/s^2]
};

/// Inertial measurement unit at the centre of gravity: mean rate of turn and mean
/// specific force over the time since its last sample, from the states at both ends.
/// Without errors, for the interval dt from the state (q-, v-) to (q+, v+),
///
///   w = log(q-^-1 q+) / dt
///   f = R_mid^-1 ((v+ - v-) / dt - g),   R_mid of q- exp(w dt/2),   g = (0, 0, kGravity)
///
/// so that a strapdown mechanisation gets the truth back, to rounding, by
///
///   q+ = q- exp(w dt),   v+ = v- + (R_mid f + g) dt,
///
/// and the position within the third power of dt by p+ = p- + (v- + v+)/2 dt. To that
/// come, per axis, scale (1 + s), constant bias, random walk (in steps of 1 s: within a
/// second it moves by far less than the noise) and white noise of density/sqrt(dt). The
/// first call only begins the first interval.
class ImuSensor final : public PeriodicSensor<ImuSensor, ImuSample> {
 public:
  /// @param instance  number among the equal sensors of this entity, from 0: each has
  ///                  errors of its own.
  ImuSensor(const ImuOptions& options, std::uint64_t seed, EntityId entity,
            std::uint32_t instance = 0);

  bool measure(const SensorView& view, ImuSample& sample);

 private:
  void walk(Time now);

  ImuOptions options_;
  FastNormals normal_;
  Vec3 gyro_scale_, gyro_bias_;
  Vec3 accelerometer_scale_, accelerometer_bias_;
  Quat q_NB_ = Quat::Identity();  // where the interval began
  Vec3 v_N_ = Vec3::Zero();
  Time since_;
  Time walked_;  // when the biases moved last
  bool started_ = false;
  std::uint8_t unit_;
};

}  // namespace skein::sensory
