// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/layer/sensory/gauss_markov.h"
#include "skein/layer/sensory/periodic_sensor.h"

namespace skein::sensory {

struct RangefinderOptions {
  double rate_hz = 10;               ///< samples per second
  double latency = 0;                ///< [s]
  double azimuth = 0;                ///< of the beam: from forward to the right [rad]
  double depression = geo::kPi / 2;  ///< of the beam: below the forward-right plane [rad]
  double range = 100;                ///< furthest it sees [m]
  double bias_sd = 0.05;             ///< of the wandering error [m]
  double bias_time = 100;            ///< its correlation time [s]
  double noise_sd = 0.02;            ///< white [m]
};

/// Distance to the ground along one beam fixed in the body, by ray casting,
///
///   y = y_true + b + w_y,   db/dt = -b/tau + w_b
///
/// and 0 where there is nothing within its range. For the agent.
class Rangefinder final : public PeriodicSensor<Rangefinder, RangeSample> {
 public:
  Rangefinder(const RangefinderOptions& options, std::uint64_t seed, EntityId entity,
              std::uint32_t instance = 0);

  bool measure(const SensorView& view, RangeSample& sample);
  bool payload() const override { return true; }

 private:
  Vec3 beam_B_;
  double range_, noise_sd_;
  FastNormals normal_;
  GaussMarkov1 bias_;
};

struct LidarOptions {
  double rate_hz = 5;     ///< scans per second
  double latency = 0.05;  ///< [s]
  int beams = 31;         ///< evenly spaced over the field of view
  double field_of_view =
      geo::radians(120);  ///< from the leftmost beam to the rightmost [rad]
  double depression = geo::radians(12);  ///< of the middle beam: below forward [rad]
  double range = 150;                    ///< furthest it sees [m]
  double bias_sd = 0.05;   ///< of the wandering error, common to all beams [m]
  double bias_time = 100;  ///< its correlation time [s]
  double noise_sd = 0.03;  ///< white, of each beam [m]
};

/// Scanning LiDAR: a fan of beams in the plane of its middle beam and the body's right,
/// each like a Rangefinder. All beams of a scan are measured at once. For the agent.
class Lidar final : public Sensor {
 public:
  Lidar(const LidarOptions& options, std::uint64_t seed, EntityId entity,
        std::uint32_t instance = 0);

  void sample(const SensorView& view, std::vector<SensorSample>& out) override;
  bool payload() const override { return true; }

 private:
  SampleClock clock_;
  Delay<RangeSample> delay_;
  std::vector<Vec3> beams_B_;
  double range_, noise_sd_;
  FastNormals normal_;
  GaussMarkov1 bias_;
};

}  // namespace skein::sensory
