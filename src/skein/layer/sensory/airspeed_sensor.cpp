// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/airspeed_sensor.h"

#include <algorithm>

namespace skein::sensory {

AirspeedSensor::AirspeedSensor(const AirspeedOptions& options, std::uint64_t seed,
                               EntityId entity, std::uint32_t instance)
    : PeriodicSensor(options.rate_hz, options.latency),
      noise_sd_(options.noise_sd),
      floor_(options.floor),
      normal_(RandomStream(seed, entity.value, Purpose::kPitot, instance)),
      bias_(options.bias_sd * normal_()),
      gain_(1 + options.scale_sd * normal_()),
      unit_(static_cast<std::uint8_t>(instance)) {}

double AirspeedSensor::felt(const SensorView& view) {
  constexpr double kCone = 0.93969262078590838;  // cosine of 20 degrees
  const VehicleState& s = view.vehicle;
  const Vec3 air = s.q_NB.conjugate() * (s.v_N - view.air.wind_N);
  if (air.x() >= kCone * air.norm()) return s.airspeed;
  return std::max(air.x(), 0.0) / kCone;
}

bool AirspeedSensor::measure(const SensorView& view, AirspeedSample& sample) {
  sample.unit = unit_;
  const double reading = gain_ * felt(view) + bias_ + noise_sd_ * normal_();
  sample.airspeed = reading < floor_ ? 0 : reading;
  return true;
}

}  // namespace skein::sensory
