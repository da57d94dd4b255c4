// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/layer/sensory/sample_clock.h"
#include "skein/role/sensor.h"

namespace skein::sensory {

struct AirDataOptions {
  double rate_hz = 10;     ///< samples per second
  double airspeed_sd = 0;  ///< of the airspeed error [m/s], white
  double heading_sd = 0;   ///< of the heading error [rad], white
};

/// Airspeed and heading.
class AirDataSensor final : public Sensor {
 public:
  /// @param instance  number among the equal sensors of this entity, from 0: each has
  ///                  errors of its own.
  AirDataSensor(const AirDataOptions& options, std::uint64_t seed, EntityId entity,
                std::uint32_t instance = 0);
  void sample(const SensorView& view, std::vector<SensorSample>& out) override;

 private:
  AirDataOptions options_;
  SampleClock clock_;
  RandomStream random_;
};

}  // namespace skein::sensory
