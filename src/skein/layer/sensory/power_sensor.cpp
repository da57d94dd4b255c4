// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/power_sensor.h"

#include <algorithm>

namespace skein::sensory {

PowerSensor::PowerSensor(const PowerOptions& options, std::uint64_t seed, EntityId entity,
                         std::uint32_t instance)
    : options_(options),
      normal_(RandomStream(seed, entity.value, Purpose::kPower, instance)),
      clock_(options.rate_hz),
      delay_(options.latency, clock_.period()),
      motor_delay_(Time::from_seconds(options.motor_delay)),
      gain_(options.gain_sd * normal_()),
      drift_(options.drift_sd / 3600 * normal_()) {}

void PowerSensor::sample(const SensorView& view, std::vector<SensorSample>& out) {
  watch_motors(view);
  if (clock_.due(view.now)) delay_.put(measure(view), out);
  delay_.release(view.now, out);
}

// At every call, so that the delay counts from the failure and not from a sample.
void PowerSensor::watch_motors(const SensorView& view) {
  const Faults& faults = view.vehicle.faults;
  const auto standing = static_cast<std::uint8_t>(
      faults.battery ? options_.motors : faults.dead & options_.motors);
  if (standing != standing_) {
    standing_ = standing;
    standing_since_ = view.now;
  }
  if (known_ != standing_ && view.now >= standing_since_ + motor_delay_)
    known_ = standing_;
}

PowerSample PowerSensor::measure(const SensorView& view) {
  const Energy& energy = view.vehicle.energy;
  if (first_charge_ < 0) {
    first_charge_ = energy.charge;
    first_time_ = view.now;
  }
  PowerSample sample;
  sample.time = view.now;
  const double voltage_noise = options_.voltage_sd * normal_();
  const double current_noise = options_.current_sd * normal_();
  if (energy.voltage > 0) {
    sample.voltage = energy.voltage + voltage_noise;
    sample.current = energy.power / energy.voltage + current_noise;
  }
  const double used = first_charge_ - energy.charge;
  const double counted =
      first_charge_ - used * (1 + gain_) - drift_ * (view.now - first_time_).seconds();
  sample.charge = std::clamp(counted, 0.0, 1.0);
  sample.motors_standing = known_;
  return sample;
}

}  // namespace skein::sensory
