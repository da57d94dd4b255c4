// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/layer/sensory/delay.h"
#include "skein/layer/sensory/sample_clock.h"
#include "skein/role/sensor.h"

namespace skein::sensory {

struct TrafficReceiverOptions {
  Transmitter hears = Transmitter::kAdsB;  ///< ADS-B or FLARM
  double rate_hz = 1;                      ///< broadcasts of each sender a second
  double latency = 0.2;                    ///< [s]
  double range = 40000;                    ///< [m]
  double reception = 0.95;  ///< probability that a broadcast in range is received
  /// Standard deviation of a sender's position per horizontal axis, which it states: each
  /// has one of its own between these [m].
  double best_position_sd = 10, worst_position_sd = 30;
  double altitude_sd = 8;    ///< [m]
  double velocity_sd = 0.7;  ///< per axis [m/s]
};

/// Receiver of what aircraft around say of themselves: ADS-B or FLARM. It hears those
/// that send, within its range; their errors are white, and they state how large these
/// are.
/// Valid: no terrain and no own airframe in between; broadcasts never collide.
class TrafficReceiver final : public Sensor {
 public:
  TrafficReceiver(const TrafficReceiverOptions& options, std::uint64_t seed,
                  EntityId entity, std::uint32_t instance = 0);

  void sample(const SensorView& view, std::vector<SensorSample>& out) override;
  bool payload() const override { return true; }
  bool finds_aircraft() const override { return true; }

 private:
  void hear(const SensorView& view, std::vector<SensorSample>& out);
  double position_sd(std::uint32_t address) const;

  TrafficReceiverOptions options_;
  std::uint64_t seed_;
  EntityId self_;
  SampleClock clock_;
  Delay<TrafficBroadcast> delay_;
  RandomStream random_;
};

}  // namespace skein::sensory
