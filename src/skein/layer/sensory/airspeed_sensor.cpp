#include "skein/layer/sensory/airspeed_sensor.h"

namespace skein::sensory {

AirspeedSensor::AirspeedSensor(const AirspeedOptions& options, std::uint64_t seed,
                               EntityId entity, std::uint32_t instance)
    : PeriodicSensor(options.rate_hz, options.latency),
      noise_sd_(options.noise_sd),
      floor_(options.floor),
      normal_(RandomStream(seed, entity.value, Purpose::kPitot, instance)),
      bias_(options.bias_sd * normal_()),
      gain_(1 + options.scale_sd * normal_()) {}

bool AirspeedSensor::measure(const SensorView& view, AirspeedSample& sample) {
  const double reading = gain_ * view.vehicle.airspeed + bias_ + noise_sd_ * normal_();
  sample.airspeed = reading < floor_ ? 0 : reading;
  return true;
}

}  // namespace skein::sensory
