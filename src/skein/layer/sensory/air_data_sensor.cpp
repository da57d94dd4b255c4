// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/air_data_sensor.h"

namespace skein::sensory {

AirDataSensor::AirDataSensor(const AirDataOptions& options, std::uint64_t seed,
                             EntityId entity, std::uint32_t instance)
    : options_(options),
      clock_(options.rate_hz),
      random_(seed, entity.value, Purpose::kAirData, instance) {}

void AirDataSensor::sample(const SensorView& view, std::vector<SensorSample>& out) {
  if (!clock_.due(view.now)) return;
  AirDataSample sample;
  sample.time = view.now;
  sample.airspeed = view.vehicle.airspeed;
  sample.heading = geo::yaw(view.vehicle.q_NB);
  // A perfect sensor draws nothing: it is the most frequent one of a run.
  if (options_.airspeed_sd > 0)
    sample.airspeed += options_.airspeed_sd * random_.normal();
  if (options_.heading_sd > 0)
    sample.heading =
        geo::wrap_pi(sample.heading + options_.heading_sd * random_.normal());
  out.emplace_back(sample);
}

}  // namespace skein::sensory
