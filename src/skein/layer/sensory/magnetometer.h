// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/layer/sensory/periodic_sensor.h"

namespace skein::sensory {

struct MagnetometerOptions {
  double rate_hz = 25;                    ///< samples per second
  double latency = 0;                     ///< [s]
  double declination = 0;                 ///< of the field: east of north [rad]
  double inclination = geo::radians(66);  ///< of the field: below the horizon [rad]
  double hard_iron_sd = 0.02;  ///< of the constant bias per axis, in field strengths
  double noise_sd = 0.005;     ///< white, per axis, in field strengths
};

/// The Earth's field over its strength, in the north-east-down frame.
Vec3 magnetic_field_N(double declination, double inclination);

/// Three-axis magnetometer: the field in the body frame, over its strength, + hard-iron
/// bias (fixed in the body) + noise.
class Magnetometer final : public PeriodicSensor<Magnetometer, MagnetometerSample> {
 public:
  Magnetometer(const MagnetometerOptions& options, std::uint64_t seed, EntityId entity,
               std::uint32_t instance = 0);

  bool measure(const SensorView& view, MagnetometerSample& sample);

 private:
  Vec3 field_N_;
  double noise_sd_;
  FastNormals normal_;
  Vec3 hard_iron_;
  std::uint8_t unit_;
};

}  // namespace skein::sensory
