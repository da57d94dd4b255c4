// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/layer/sensory/sample_clock.h"
#include "skein/role/sensor.h"

namespace skein::sensory {

struct GnssOptions {
  double rate_hz = 5;            ///< fixes per second
  double position_sd = 2;        ///< of the error per horizontal axis [m]; 0 = perfect
  double altitude_sd = 3;        ///< of the vertical error [m]
  double correlation_time = 60;  ///< of the position error [s]; 0 = white
  double velocity_sd = 0.1;      ///< of the velocity error per axis [m/s], white
};

/// Satellite navigation with a position error that wanders.
///
///   e(t + dt) = phi e(t) + sd sqrt(1 - phi^2) n,  phi = exp(-dt / correlation_time)
///
/// (first-order Gauss-Markov, started in its steady state).
class GnssSensor final : public Sensor {
 public:
  /// @param instance  number among the equal sensors of this entity, from 0: each has
  ///                  errors of its own.
  GnssSensor(const GnssOptions& options, std::uint64_t seed, EntityId entity,
             std::uint32_t instance = 0);
  void sample(const SensorView& view, std::vector<SensorSample>& out) override;

 private:
  GnssOptions options_;
  SampleClock clock_;
  RandomStream random_;
  Vec3 error_ = Vec3::Zero();  // in standard deviations
  bool started_ = false;
};

}  // namespace skein::sensory
