// SPDX-License-Identifier: Apache-2.0
#include "radiometer.h"

namespace my_kinds {
namespace {

// The first of the numbers that are free for plugins.
constexpr auto kRadiometerNoise =
    static_cast<skein::Purpose>(static_cast<std::uint32_t>(skein::Purpose::kPlugin));

// The share of a disc that burns, from its centre and two circles of equal weight.
double burning_share(skein::Phenomena fires, const skein::Vec2& centre, double radius) {
  constexpr int kRings = 2, kPerRing = 6;
  int burning = skein::inside(fires, {}, centre) ? 1 : 0;
  for (int ring = 1; ring <= kRings; ++ring)
    for (int k = 0; k < kPerRing; ++k) {
      const double bearing = 2 * skein::geo::kPi * (k + 0.5 * ring) / kPerRing;
      const double distance = radius * ring / kRings;
      if (skein::inside(fires, {}, centre + distance * skein::geo::unit(bearing)))
        ++burning;
    }
  return burning / (1.0 + kRings * kPerRing);
}

}  // namespace

Radiometer::Radiometer(const RadiometerOptions& options, std::uint64_t seed,
                       skein::EntityId entity, std::uint32_t instance)
    : options_(options),
      clock_(options.rate_hz),
      random_(seed, entity.value, kRadiometerNoise, instance) {}

void Radiometer::sample(const skein::SensorView& view,
                        std::vector<skein::SensorSample>& out) {
  if (!clock_.due(view.now)) return;
  const double noise = options_.noise * random_.normal();
  const skein::Vec2 below = skein::geo::horizontal(view.vehicle.p_N);
  const double height = -view.vehicle.p_N.z() - view.terrain.elevation_msl(below);
  if (height <= 0) return;
  const double radius = height * skein::math::tan(options_.half_angle);
  const double measured = burning_share(view.phenomena, below, radius) + noise;
  out.emplace_back(skein::FireSample{view.now, 0, measured > options_.share});
}

}  // namespace my_kinds
