// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/traffic_radar.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"

namespace skein::sensory {
namespace {

constexpr std::size_t kUsualPlots = 8;  // aircraft in view
constexpr double kNearestPlot = 1;      // of what a range is said [m]

}  // namespace

TrafficRadar::TrafficRadar(const TrafficRadarOptions& options, std::uint64_t seed,
                           EntityId entity, std::uint32_t instance)
    : options_(options),
      self_(entity),
      clock_(options.rate_hz),
      delay_(options.latency, clock_.period(), kUsualPlots),
      random_(seed, entity.value, Purpose::kTrafficSensor, 256 + instance) {}

void TrafficRadar::sample(const SensorView& view, std::vector<SensorSample>& out) {
  if (clock_.due(view.now)) scan(view, out);
  delay_.release(view.now, out);
}

void TrafficRadar::scan(const SensorView& view, std::vector<SensorSample>& out) {
  const double range2 = options_.range * options_.range;
  const double heading = geo::yaw(view.vehicle.q_NB);
  const Quat q_BN = view.vehicle.q_NB.conjugate();
  for (const VisibleAircraft& other : view.aircraft) {
    const Vec3 away_N = other.p_N - view.vehicle.p_N;
    if (other.entity == self_ || away_N.squaredNorm() > range2) continue;
    const double range = away_N.norm();
    if (range < kNearestPlot) continue;
    const Vec3 away_B = q_BN * away_N;
    const double across = math::atan2(away_B.y(), away_B.x());
    const double up = math::asin(std::clamp(-away_B.z() / range, -1.0, 1.0));
    if (std::abs(across) > options_.width / 2 || std::abs(up) > options_.height / 2)
      continue;
    const double luck = random_.uniform();
    const auto noise = random_.normals4();
    if (luck >= options_.detection) continue;
    RadarPlot plot{view.now};
    plot.range = std::max(kNearestPlot, range + options_.range_sd * noise[0]);
    plot.range_sd = options_.range_sd;
    plot.bearing = geo::wrap_pi(geo::bearing(geo::horizontal(away_N)) - heading +
                                options_.bearing_sd * noise[1]);
    plot.bearing_sd = options_.bearing_sd;
    plot.elevation = math::asin(std::clamp(-away_N.z() / range, -1.0, 1.0)) +
                     options_.elevation_sd * noise[2];
    plot.elevation_sd = options_.elevation_sd;
    delay_.put(plot, out);
  }
}

}  // namespace skein::sensory
