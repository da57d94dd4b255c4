// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/layer/sensory/periodic_sensor.h"

namespace skein::sensory {

struct HeightOptions {
  double rate_hz = 20;         ///< samples per second
  double latency = 0;          ///< [s]
  double range = 50;           ///< higher up it says nothing [m]
  double noise_sd = 0.05;      ///< white [m]
  double relative_sd = 0.005;  ///< white, of the height, in quadrature [-]
};

/// Height above the ground straight below, for take-off and landing. Says nothing beyond
/// its range.
class HeightSensor final : public PeriodicSensor<HeightSensor, HeightSample> {
 public:
  HeightSensor(const HeightOptions& options, std::uint64_t seed, EntityId entity,
               std::uint32_t instance = 0);

  bool measure(const SensorView& view, HeightSample& sample);

 private:
  double range_, noise_sd_, relative_sd_;
  FastNormals normal_;
};

}  // namespace skein::sensory
