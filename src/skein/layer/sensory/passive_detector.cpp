// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/passive_detector.h"

#include "skein/base/math.h"

namespace skein::sensory {
namespace {

constexpr std::size_t kUsualTransponders = 8;  // transponders around

}  // namespace

PassiveDetector::PassiveDetector(const PassiveDetectorOptions& options,
                                 std::uint64_t seed, EntityId entity,
                                 std::uint32_t instance)
    : options_(options),
      self_(entity),
      clock_(options.rate_hz),
      delay_(options.latency, clock_.period(), kUsualTransponders),
      random_(seed, entity.value, Purpose::kTrafficSensor, 512 + instance) {}

void PassiveDetector::sample(const SensorView& view, std::vector<SensorSample>& out) {
  if (clock_.due(view.now)) listen(view, out);
  delay_.release(view.now, out);
}

void PassiveDetector::listen(const SensorView& view, std::vector<SensorSample>& out) {
  const double range2 = options_.range * options_.range;
  const double heading = geo::yaw(view.vehicle.q_NB);
  for (const VisibleAircraft& other : view.aircraft) {
    const Vec3 away_N = other.p_N - view.vehicle.p_N;
    if (other.entity == self_ || !other.sends.transponder ||
        away_N.squaredNorm() > range2)
      continue;
    const double luck = random_.uniform(), altitude_luck = random_.uniform();
    const auto noise = random_.normals4();
    if (luck >= options_.detection) continue;
    const Vec2 away = geo::horizontal(away_N);
    TransponderContact contact{view.now};
    contact.range = away.norm() * math::exp(options_.range_sd * noise[0]);
    contact.range_sd = options_.range_sd * contact.range;
    contact.bearing =
        geo::wrap_pi(geo::bearing(away) - heading + options_.bearing_sd * noise[1]);
    contact.bearing_sd = options_.bearing_sd;
    contact.height_sd = options_.height_sd;
    if (altitude_luck < options_.height_share)
      contact.height = -away_N.z() + options_.height_sd * noise[2];
    delay_.put(contact, out);
  }
}

}  // namespace skein::sensory
