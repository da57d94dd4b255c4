// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/fire_sensor.h"

namespace skein::sensory {

FireSensor::FireSensor(const FireSensorOptions& options, std::uint64_t seed,
                       EntityId entity, std::uint32_t instance)
    : options_(options),
      clock_(options.rate_hz),
      random_(seed, entity.value, Purpose::kFireSensor, instance) {}

void FireSensor::sample(const SensorView& view, std::vector<SensorSample>& out) {
  if (!clock_.due(view.now)) return;
  // Drawn before looking, so that reading k uses number k wherever the vehicle is.
  const double luck = random_.uniform();
  const Vec2 point = geo::horizontal(view.vehicle.p_N) +
                     options_.look_ahead * geo::unit(geo::yaw(view.vehicle.q_NB));
  const double height = -view.vehicle.p_N.z() - view.terrain.elevation_msl(point);
  if (height > options_.max_height) return;
  const bool burns = inside(view.phenomena, options_.phenomenon, point);
  const bool wrong = luck < (burns ? options_.false_out : options_.false_in);
  out.emplace_back(FireSample{view.now, options_.look_ahead, burns != wrong});
}

}  // namespace skein::sensory
