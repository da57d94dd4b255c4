// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/layer/sensory/sample_clock.h"
#include "skein/role/sensor.h"

namespace my_kinds {

struct RadiometerOptions {
  double rate_hz = 1;
  double half_angle = 0.1;  ///< of the cone it looks down through [rad]
  double share = 0.5;       ///< of the ground in view that must burn
  double noise = 0.05;      ///< standard deviation of the share that it measures
};

/// A radiometer that looks straight down: it says "inside" where enough of the disc of
/// ground in its view burns. From higher up it sees a larger disc, so the edge blurs.
///
///   measured = (burning points of the disc) / (points of the disc) + noise
class Radiometer final : public skein::Sensor {
 public:
  Radiometer(const RadiometerOptions& options, std::uint64_t seed, skein::EntityId entity,
             std::uint32_t instance);

  /// What it sees of the fire is for the agent.
  bool payload() const override { return true; }
  void sample(const skein::SensorView& view,
              std::vector<skein::SensorSample>& out) override;

 private:
  RadiometerOptions options_;
  skein::sensory::SampleClock clock_;
  skein::RandomStream random_;
};

}  // namespace my_kinds
