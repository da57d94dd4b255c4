// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/anemometer.h"

namespace skein::sensory {

Anemometer::Anemometer(const AnemometerOptions& options, std::uint64_t seed,
                       EntityId entity, std::uint32_t instance)
    : PeriodicSensor(options.rate_hz, options.latency),
      noise_sd_(options.noise_sd),
      normal_(RandomStream(seed, entity.value, Purpose::kAnemometer, instance)),
      bias_(options.bias_sd, period(), options.bias_time, normal_) {}

bool Anemometer::measure(const SensorView& view, AnemometerSample& sample) {
  const Vec3 through_N = view.vehicle.v_N - view.air.wind_N;
  sample.v_AB_B = view.vehicle.q_NB.conjugate() * through_N + bias_.value() +
                  noise_sd_ * normal3(normal_);
  bias_.step(normal_);
  return true;
}

}  // namespace skein::sensory
