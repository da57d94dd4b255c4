// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <variant>

#include "skein/layer/asset/body/battery.h"
#include "skein/layer/asset/body/fuel_tank.h"

namespace skein::asset {

/// What feeds a vehicle's motors; none: they always get what they ask for, and no energy
/// is counted.
using EnergySource = std::variant<std::monostate, Battery, FuelTank>;

/// Takes `power` [W] for `dt` [s] out of `source`; returns the share that it gives.
inline double draw(const EnergySource& source, Energy& energy, const Faults& faults,
                   double power, double dt) {
  if (const auto* battery = std::get_if<Battery>(&source))
    return battery->draw(energy, faults, power, dt);
  if (const auto* tank = std::get_if<FuelTank>(&source))
    return tank->draw(energy, faults, power, dt);
  if (faults.battery) {
    energy.power = 0;
    return 0;
  }
  energy.power = power;
  return 1;
}

/// How long the power drawn now lasts [s].
inline double endurance(const EnergySource& source, const Energy& energy) {
  if (const auto* battery = std::get_if<Battery>(&source))
    return battery->endurance(energy);
  if (const auto* tank = std::get_if<FuelTank>(&source)) return tank->endurance(energy);
  return std::numeric_limits<double>::infinity();
}

}  // namespace skein::asset
