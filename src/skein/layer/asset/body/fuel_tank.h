// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/vehicle.h"
#include "skein/layer/asset/body/parameter_error.h"

namespace skein::asset {

/// Fuel of a piston engine. The defaults are a light-sport aircraft.
struct FuelTankParameters {
  double fuel = 72;                ///< when full [kg]
  double consumption = 7.9e-8;     ///< for work at the shaft [kg/J]
  double idle_consumption = 4e-4;  ///< beside it, as long as the engine runs [kg/s]
};

/// What must hold for a tank.
std::vector<ParameterError> errors(const FuelTankParameters& parameters);

/// Fuel used by power: fuel' = -(idle_consumption + consumption power). `charge` of the
/// vehicle's `Energy` is the share of the fuel that is left; its voltage stays 0.
class FuelTank {
 public:
  explicit FuelTank(const FuelTankParameters& parameters);

  /// Takes the fuel for `power` [W] at the shaft for `dt` [s]; sets charge and power.
  /// `faults.battery` means here that no fuel comes.
  /// @returns  the share of `power` that the engine gives: 1, less in the step in which
  ///           the fuel ends, then 0.
  double draw(Energy& energy, const Faults& faults, double power, double dt) const;

  /// Fuel on board [kg].
  double fuel(double charge) const { return charge * fuel_; }

  /// How long the fuel lasts at the power given now [s].
  double endurance(const Energy& energy) const;

 private:
  double rate(double power) const { return idle_ + consumption_ * power; }

  double fuel_;         // [kg]
  double consumption_;  // [kg/J]
  double idle_;         // [kg/s]
};

}  // namespace skein::asset
