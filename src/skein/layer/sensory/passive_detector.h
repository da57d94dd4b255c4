// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/layer/sensory/delay.h"
#include "skein/layer/sensory/sample_clock.h"
#include "skein/role/sensor.h"

namespace skein::sensory {

struct PassiveDetectorOptions {
  double rate_hz = 1;                    ///< looks a second
  double latency = 0.5;                  ///< [s]
  double range = 9000;                   ///< [m]
  double detection = 0.9;                ///< probability, per look
  double range_sd = 0.2;                 ///< share of the range
  double bearing_sd = geo::radians(20);  ///< [rad]
  double height_sd = 60;                 ///< of the height over the own one [m]
  double height_share = 0.8;             ///< of replies that have an altitude
};

/// Passive detector of transponders, like the small ones of gliders and light aircraft:
/// it hears replies to other radars, takes their strength for the range and the antenna
/// sector for the bearing, and reads the altitude if it is in the reply.
///
/// Errors are white; strengths are off by decibels, so the horizontal range by a factor
/// exp(sd n). Nobody who sends nothing is found.
/// Valid: there is always a radar that asks; replies never overlap.
class PassiveDetector final : public Sensor {
 public:
  PassiveDetector(const PassiveDetectorOptions& options, std::uint64_t seed,
                  EntityId entity, std::uint32_t instance = 0);

  void sample(const SensorView& view, std::vector<SensorSample>& out) override;
  bool payload() const override { return true; }
  bool finds_aircraft() const override { return true; }

 private:
  void listen(const SensorView& view, std::vector<SensorSample>& out);

  PassiveDetectorOptions options_;
  EntityId self_;
  SampleClock clock_;
  Delay<TransponderContact> delay_;
  RandomStream random_;
};

}  // namespace skein::sensory
