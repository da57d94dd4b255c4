// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/layer/sensory/delay.h"
#include "skein/layer/sensory/sample_clock.h"
#include "skein/role/sensor.h"

namespace skein::sensory {

struct TrafficRadarOptions {
  double rate_hz = 1;                       ///< scans a second
  double latency = 0.1;                     ///< [s]
  double range = 3000;                      ///< [m]
  double width = geo::radians(120);         ///< field of view across [rad]
  double height = geo::radians(80);         ///< field of view up and down [rad]
  double detection = 0.9;                   ///< probability, per scan
  double range_sd = 10;                     ///< [m]
  double bearing_sd = geo::radians(1.5);    ///< [rad]
  double elevation_sd = geo::radians(1.5);  ///< [rad]
};

/// Radar that looks forward, fixed to the airframe: range, bearing and elevation of what
/// flies within its field of view. It finds all aircraft, whatever they carry, and does
/// not know who they are. Angles are said in level axes, the bearing from the nose.
/// Valid: no terrain in between; no echoes of the ground.
class TrafficRadar final : public Sensor {
 public:
  TrafficRadar(const TrafficRadarOptions& options, std::uint64_t seed, EntityId entity,
               std::uint32_t instance = 0);

  void sample(const SensorView& view, std::vector<SensorSample>& out) override;
  bool payload() const override { return true; }
  bool finds_aircraft() const override { return true; }

 private:
  void scan(const SensorView& view, std::vector<SensorSample>& out);

  TrafficRadarOptions options_;
  EntityId self_;
  SampleClock clock_;
  Delay<RadarPlot> delay_;
  RandomStream random_;
};

}  // namespace skein::sensory
