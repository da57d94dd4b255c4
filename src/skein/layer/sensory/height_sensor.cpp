// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/height_sensor.h"

#include "skein/base/math.h"

namespace skein::sensory {

HeightSensor::HeightSensor(const HeightOptions& options, std::uint64_t seed,
                           EntityId entity, std::uint32_t instance)
    : PeriodicSensor(options.rate_hz, options.latency),
      range_(options.range),
      noise_sd_(options.noise_sd),
      relative_sd_(options.relative_sd),
      normal_(RandomStream(seed, entity.value, Purpose::kHeight, instance)) {}

bool HeightSensor::measure(const SensorView& view, HeightSample& sample) {
  const double noise = normal_();  // drawn in any case: reading k uses number k
  const Vec3& p_N = view.vehicle.p_N;
  const double height = -p_N.z() - view.terrain.elevation_msl(geo::horizontal(p_N));
  if (height > range_) return false;
  sample.height_agl = height + noise * math::hypot(noise_sd_, relative_sd_ * height);
  return true;
}

}  // namespace skein::sensory
