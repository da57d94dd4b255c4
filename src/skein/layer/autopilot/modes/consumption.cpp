// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/modes/consumption.h"

#include <algorithm>

namespace skein::autopilot {

void Consumption::sense(Time time, double charge) {
  if (!begun_) {
    begun_ = true;
    first_ = last_ = time;
    charge_first_ = charge_ = charge;
    return;
  }
  const double dt = (time - last_).seconds();
  if (dt <= 0) return;
  const double since = std::min(options_.lag, (time - first_).seconds());
  const double used = (charge_ - charge) / dt;
  rate_ += std::min(1.0, dt / since) * (used - rate_);
  last_ = time;
  charge_ = charge;
}

std::optional<double> Consumption::endurance() const {
  if (rate_ <= 0) return std::nullopt;
  return charge_ / rate_;
}

void Consumption::set_powers(HomeFlight& flight) const {
  const double flown = (last_ - first_).seconds();
  const double mean = flown > 0 ? (charge_first_ - charge_) / flown : 0;
  flight.power_level = std::max({0.0, rate_, mean});
  flight.power_climb = options_.climb_factor * flight.power_level;
  flight.power_sink = options_.sink_factor * flight.power_level;
}

}  // namespace skein::autopilot
