// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/barometer.h"

namespace skein::sensory {

Barometer::Barometer(const BarometerOptions& options, std::uint64_t seed, EntityId entity,
                     std::uint32_t instance)
    : PeriodicSensor(options.rate_hz, options.latency),
      noise_sd_(options.noise_sd),
      normal_(RandomStream(seed, entity.value, Purpose::kBarometer, instance)),
      bias_(options.bias_sd * normal_()),
      drift_(options.drift_sd, period(), options.drift_time, normal_),
      unit_(static_cast<std::uint8_t>(instance)) {}

bool Barometer::measure(const SensorView& view, BarometerSample& sample) {
  sample.unit = unit_;
  sample.altitude_msl =
      -view.vehicle.p_N.z() + bias_ + drift_.value() + noise_sd_ * normal_();
  drift_.step(normal_);
  return true;
}

}  // namespace skein::sensory
