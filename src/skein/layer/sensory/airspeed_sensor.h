// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/layer/sensory/periodic_sensor.h"

namespace skein::sensory {

struct AirspeedOptions {
  double rate_hz = 25;     ///< samples per second
  double latency = 0;      ///< [s]
  double bias_sd = 0.2;    ///< of the constant error [m/s]
  double scale_sd = 0.02;  ///< of the relative scale error [-]
  double noise_sd = 0.3;   ///< white [m/s]
  double floor = 3;        ///< slower readings say 0: too little pressure [m/s]
};

/// Pitot tube: airspeed (1 + scale) + bias + noise, and 0 below a floor. Not sensitive to
/// angles of attack and side-slip up to 20 degrees together; beyond, it feels the part of
/// the air's speed that comes from ahead, and nothing from behind.
class AirspeedSensor final : public PeriodicSensor<AirspeedSensor, AirspeedSample> {
 public:
  AirspeedSensor(const AirspeedOptions& options, std::uint64_t seed, EntityId entity,
                 std::uint32_t instance = 0);

  bool measure(const SensorView& view, AirspeedSample& sample);

 private:
  // Airspeed as the tube feels it [m/s].
  static double felt(const SensorView& view);

  double noise_sd_;
  double floor_;
  FastNormals normal_;
  double bias_;
  double gain_;
  std::uint8_t unit_;
};

}  // namespace skein::sensory
