// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/gnss_sensor.h"

#include <cmath>

#include "skein/base/math.h"

namespace skein::sensory {

GnssSensor::GnssSensor(const GnssOptions& options, std::uint64_t seed, EntityId entity,
                       std::uint32_t instance)
    : options_(options),
      clock_(options.rate_hz),
      random_(seed, entity.value, Purpose::kGnss, instance) {}

void GnssSensor::sample(const SensorView& view, std::vector<SensorSample>& out) {
  if (!clock_.due(view.now)) return;
  const double keep = started_ && options_.correlation_time > 0
                          ? math::exp(-clock_.period() / options_.correlation_time)
                          : 0;
  started_ = true;
  GnssFix fix;
  fix.time = view.now;
  fix.v_N = view.vehicle.v_N;
  for (int axis = 0; axis < 3; ++axis) {
    error_[axis] = keep * error_[axis] + std::sqrt(1 - keep * keep) * random_.normal();
    fix.v_N[axis] += options_.velocity_sd * random_.normal();
  }
  const Vec3 sd{options_.position_sd, options_.position_sd, options_.altitude_sd};
  fix.p_N = view.vehicle.p_N + sd.cwiseProduct(error_);
  fix.position_sd = options_.position_sd;
  fix.altitude_sd = options_.altitude_sd;
  fix.velocity_sd = options_.velocity_sd;
  out.emplace_back(fix);
}

}  // namespace skein::sensory
