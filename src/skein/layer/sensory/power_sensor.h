// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/layer/sensory/periodic_sensor.h"

namespace skein::sensory {

struct PowerOptions {
  double rate_hz = 5;          ///< samples per second
  double latency = 0;          ///< [s]
  double voltage_sd = 0.02;    ///< white [V]
  double current_sd = 0.1;     ///< white [A]
  double gain_sd = 0.01;       ///< of the relative error of the counted charge [-]
  double drift_sd = 0.005;     ///< of the rate at which counting goes wrong [1/h]
  double motor_delay = 0.2;    ///< until a motor is known to stand [s]
  std::uint8_t motors = 0xff;  ///< bit k: actuator channel k is a motor
};

/// Battery monitor and motor speeds.
///
///   voltage = true + noise,   current = power / true voltage + noise,
///   charge  = c0 - (c0 - c)(1 + gain) - drift t   (from 0 to 1),
///
/// with c the true charge, c0 the one at the first sample and t the time since. Where the
/// plant models no voltage, voltage and current are 0. A motor stands when its actuator
/// is dead or the battery gives nothing.
class PowerSensor final : public Sensor {
 public:
  PowerSensor(const PowerOptions& options, std::uint64_t seed, EntityId entity,
              std::uint32_t instance = 0);

  void sample(const SensorView& view, std::vector<SensorSample>& out) override;

 private:
  PowerSample measure(const SensorView& view);
  void watch_motors(const SensorView& view);

  PowerOptions options_;
  FastNormals normal_;
  SampleClock clock_;
  Delay<PowerSample> delay_;
  Time motor_delay_;
  double gain_;
  double drift_;              // [1/s]
  double first_charge_ = -1;  // none yet
  Time first_time_;
  Time standing_since_;        // when the motors that stand last changed
  std::uint8_t standing_ = 0;  // truth
  std::uint8_t known_ = 0;     // reported
};

}  // namespace skein::sensory
