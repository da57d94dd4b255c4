// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/data/vehicle/pilot.h"
#include "skein/layer/sensory/sample_clock.h"
#include "skein/role/sensor.h"

namespace skein::sensory {

/// When the pilot flies, how, and where the sticks are held.
struct Takeover {
  double from = 0;                            ///< [s]
  double until = 0;                           ///< [s]; then the pilot hands back
  FlightMode mode = FlightMode::kStabilized;  ///< or kManual
  double roll = 0;                            ///< right positive, -1 to 1
  double pitch = 0;                           ///< nose up positive, -1 to 1
  double yaw = 0;                             ///< right positive, -1 to 1
  double throttle = 0.5;                      ///< 0 to 1
};

struct SafetyPilotOptions {
  double rate_hz = 50;                   ///< of the receiver's output
  std::vector<Takeover> takeovers = {};  ///< the first one that holds counts
};

/// The safety pilot's receiver on board: gives out the sticks all the time, and whether
/// the pilot takes over.
class SafetyPilot final : public Sensor {
 public:
  explicit SafetyPilot(const SafetyPilotOptions& options);

  void sample(const SensorView& view, std::vector<SensorSample>& out) override;

 private:
  SampleClock clock_;
  std::vector<Takeover> takeovers_;
};

}  // namespace skein::sensory
