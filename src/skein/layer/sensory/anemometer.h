// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/layer/sensory/gauss_markov.h"
#include "skein/layer/sensory/periodic_sensor.h"

namespace skein::sensory {

struct AnemometerOptions {
  double rate_hz = 10;     ///< samples per second
  double latency = 0;      ///< [s]
  double bias_sd = 0.2;    ///< of the wandering error per axis [m/s]
  double bias_time = 300;  ///< its correlation time [s]
  double noise_sd = 0.2;   ///< white, per axis [m/s]
};

/// On-board anemometer: velocity of the vehicle through the air, in the body frame,
///
///   y = y_true + b + w_y,   db/dt = -b/tau + w_b
///
/// Its samples go to the autopilot, whose wind estimate is what the agent gets.
class Anemometer final : public PeriodicSensor<Anemometer, AnemometerSample> {
 public:
  Anemometer(const AnemometerOptions& options, std::uint64_t seed, EntityId entity,
             std::uint32_t instance = 0);

  bool measure(const SensorView& view, AnemometerSample& sample);

 private:
  double noise_sd_;
  FastNormals normal_;
  GaussMarkov3 bias_;
};

}  // namespace skein::sensory
