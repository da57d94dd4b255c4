// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/rangefinder.h"

#include <algorithm>

#include "skein/base/math.h"
#include "skein/layer/sensory/ray_cast.h"

namespace skein::sensory {
namespace {

constexpr double kMin = 0.01;  // [m]: 0 would say that there is nothing

RangeSample look(const SensorView& view, const Vec3& beam_B, double range, double error) {
  RangeSample sample{view.now, beam_B};
  const auto distance =
      ray_cast(view.terrain, view.vehicle.p_N, view.vehicle.q_NB * beam_B, range);
  if (distance) sample.range = std::max(*distance + error, kMin);
  return sample;
}

std::vector<Vec3> fan(const LidarOptions& options) {
  SKEIN_CHECK(options.beams > 0, options.beams);
  const Vec3 middle{math::cos(options.depression), 0, math::sin(options.depression)};
  const Vec3 right{0, 1, 0};
  std::vector<Vec3> beams;
  for (int i = 0; i < options.beams; ++i) {
    const double share = options.beams > 1 ? double(i) / (options.beams - 1) - 0.5 : 0;
    const double angle = share * options.field_of_view;
    beams.push_back(math::cos(angle) * middle + math::sin(angle) * right);
  }
  return beams;
}

}  // namespace

Rangefinder::Rangefinder(const RangefinderOptions& options, std::uint64_t seed,
                         EntityId entity, std::uint32_t instance)
    : PeriodicSensor(options.rate_hz, options.latency),
      beam_B_(math::cos(options.depression) * math::cos(options.azimuth),
              math::cos(options.depression) * math::sin(options.azimuth),
              math::sin(options.depression)),
      range_(options.range),
      noise_sd_(options.noise_sd),
      normal_(RandomStream(seed, entity.value, Purpose::kRange, instance)),
      bias_(options.bias_sd, period(), options.bias_time, normal_) {}

bool Rangefinder::measure(const SensorView& view, RangeSample& sample) {
  sample = look(view, beam_B_, range_, bias_.value() + noise_sd_ * normal_());
  bias_.step(normal_);
  return true;
}

Lidar::Lidar(const LidarOptions& options, std::uint64_t seed, EntityId entity,
             std::uint32_t instance)
    : clock_(options.rate_hz),
      delay_(options.latency, clock_.period(), static_cast<std::size_t>(options.beams)),
      beams_B_(fan(options)),
      range_(options.range),
      noise_sd_(options.noise_sd),
      normal_(RandomStream(seed, entity.value, Purpose::kLidar, instance)),
      bias_(options.bias_sd, clock_.period(), options.bias_time, normal_) {}

void Lidar::sample(const SensorView& view, std::vector<SensorSample>& out) {
  if (clock_.due(view.now)) {
    for (const Vec3& beam_B : beams_B_)
      delay_.put(look(view, beam_B, range_, bias_.value() + noise_sd_ * normal_()), out);
    bias_.step(normal_);
  }
  delay_.release(view.now, out);
}

}  // namespace skein::sensory
