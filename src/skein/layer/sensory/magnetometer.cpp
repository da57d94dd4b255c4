// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/magnetometer.h"

#include "skein/base/math.h"
#include "skein/layer/sensory/gauss_markov.h"

namespace skein::sensory {

Vec3 magnetic_field_N(double declination, double inclination) {
  const double level = math::cos(inclination);
  return {level * math::cos(declination), level * math::sin(declination),
          math::sin(inclination)};
}

Magnetometer::Magnetometer(const MagnetometerOptions& options, std::uint64_t seed,
                           EntityId entity, std::uint32_t instance)
    : PeriodicSensor(options.rate_hz, options.latency),
      field_N_(magnetic_field_N(options.declination, options.inclination)),
      noise_sd_(options.noise_sd),
      normal_(RandomStream(seed, entity.value, Purpose::kMagnetometer, instance)),
      hard_iron_(options.hard_iron_sd * normal3(normal_)),
      unit_(static_cast<std::uint8_t>(instance)) {}

bool Magnetometer::measure(const SensorView& view, MagnetometerSample& sample) {
  sample.unit = unit_;
  sample.m_B = view.vehicle.q_NB.conjugate() * field_N_ + hard_iron_ +
               noise_sd_ * normal3(normal_);
  return true;
}

}  // namespace skein::sensory
