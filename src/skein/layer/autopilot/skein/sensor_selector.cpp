// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/skein/sensor_selector.h"

#include <algorithm>

namespace skein::autopilot {
namespace {

// In the order of FlightSensor [s].
constexpr std::array<double, kFlightSensors> kPatience = {0.2, 1, 1, 1, 3};
constexpr double kSwitchAfter = 2.5;  // intervals of silence, when a spare is received
constexpr double kLostAfter = 5;      // intervals of silence, at least
constexpr double kRateUnknown = 10;   // patience after the very first sample [s]

std::size_t place(FlightSensor sensor) {
  return static_cast<std::size_t>(sensor);
}

}  // namespace

SensorSelector::SensorSelector(Time start, std::uint8_t fitted) : watched_(fitted) {
  for (Kind& kind : kinds_) kind.last = start;
}

SensorSelector::Use SensorSelector::take(FlightSensor sensor, std::uint8_t unit,
                                         Time time) {
  Kind& kind = kinds_[place(sensor)];
  watched_ = static_cast<std::uint8_t>(watched_ | 1u << place(sensor));
  const double silence = (time - kind.last).seconds();
  if (kind.heard && unit != kind.unit) {
    if (silence <= kSwitchAfter * kind.interval) return Use::kNo;
    kind.unit = unit;
    kind.last = time;
    return Use::kAnew;
  }
  const bool gap = kind.interval > 0 && silence > kSwitchAfter * kind.interval;
  if (kind.heard && silence > 0 && !gap) kind.interval = silence;
  kind.heard = true;
  kind.unit = unit;
  kind.last = time;
  return Use::kYes;
}

std::uint8_t SensorSelector::lost(Time now) const {
  unsigned bits = 0;
  for (std::size_t k = 0; k < kFlightSensors; ++k) {
    if ((watched_ >> k & 1u) == 0) continue;
    const Kind& kind = kinds_[k];
    double patience = std::max(kPatience[k], kLostAfter * kind.interval);
    if (kind.heard && kind.interval <= 0) patience = kRateUnknown;
    if ((now - kind.last).seconds() > patience) bits |= 1u << k;
  }
  return static_cast<std::uint8_t>(bits);
}

std::array<std::uint8_t, kFlightSensors> SensorSelector::units() const {
  std::array<std::uint8_t, kFlightSensors> all{};
  for (std::size_t k = 0; k < kFlightSensors; ++k) all[k] = kinds_[k].unit;
  return all;
}

}  // namespace skein::autopilot
