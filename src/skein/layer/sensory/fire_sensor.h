// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/layer/sensory/sample_clock.h"
#include "skein/role/sensor.h"

namespace skein::sensory {

struct FireSensorOptions {
  double rate_hz = 1;     ///< readings per second
  double look_ahead = 0;  ///< of the looked-at point, horizontally along the heading [m]
  double max_height = 1000;  ///< above that point; higher up there are no readings [m]
  double false_in = 0;       ///< probability of "inside" over ground that does not burn
  double false_out = 0;      ///< probability of "outside" over ground that does
  std::optional<std::uint32_t> phenomenon = {};  ///< that it senses; none: all
};

/// The cheap in/out sensor: does the ground at one point burn, or has it burnt?
class FireSensor final : public Sensor {
 public:
  /// @param instance  number among the equal sensors of this entity, from 0: each has
  ///                  errors of its own.
  FireSensor(const FireSensorOptions& options, std::uint64_t seed, EntityId entity,
             std::uint32_t instance = 0);
  void sample(const SensorView& view, std::vector<SensorSample>& out) override;
  bool payload() const override { return true; }
  bool senses_fire() const override { return true; }

 private:
  FireSensorOptions options_;
  SampleClock clock_;
  RandomStream random_;
};

}  // namespace skein::sensory
