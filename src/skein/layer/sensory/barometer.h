// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/layer/sensory/gauss_markov.h"
#include "skein/layer/sensory/periodic_sensor.h"

namespace skein::sensory {

struct BarometerOptions {
  double rate_hz = 25;      ///< samples per second
  double latency = 0;       ///< [s]
  double bias_sd = 1;       ///< of the constant error: pressure set at the start [m]
  double drift_sd = 1;      ///< of the wandering error: weather, temperature [m]
  double drift_time = 600;  ///< its correlation time [s]
  double noise_sd = 0.3;    ///< white [m]
};

/// Barometric altimeter: altitude above mean sea level + bias + slow first-order
/// Gauss-Markov drift + noise.
class Barometer final : public PeriodicSensor<Barometer, BarometerSample> {
 public:
  Barometer(const BarometerOptions& options, std::uint64_t seed, EntityId entity,
            std::uint32_t instance = 0);

  bool measure(const SensorView& view, BarometerSample& sample);

 private:
  double noise_sd_;
  FastNormals normal_;
  double bias_;
  GaussMarkov1 drift_;
  std::uint8_t unit_;
};

}  // namespace skein::sensory
