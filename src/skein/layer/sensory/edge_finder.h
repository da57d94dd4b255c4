// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/sensory/sample_clock.h"
#include "skein/role/sensor.h"

namespace skein::sensory {

struct EdgeFinderOptions {
  double rate_hz = 1;            ///< samples per second
  double range = 2000;           ///< boundaries further away are not seen [m]
  std::uint32_t phenomenon = 0;  ///< whose boundary it sees
};

/// The ideal edge finder: sees the nearest point of the true boundary, without error.
class EdgeFinder final : public Sensor {
 public:
  explicit EdgeFinder(const EdgeFinderOptions& options);

  /// Cost: linear in the points of the boundary.
  void sample(const SensorView& view, std::vector<SensorSample>& out) override;
  bool payload() const override { return true; }
  bool senses_fire() const override { return true; }

 private:
  EdgeFinderOptions options_;
  SampleClock clock_;
};

}  // namespace skein::sensory
