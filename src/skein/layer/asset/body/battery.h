// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "skein/data/vehicle/vehicle.h"
#include "skein/layer/asset/body/parameter_error.h"

namespace skein::asset {

/// A battery of equal cells in series. The defaults are a hobby lithium-polymer pack.
struct BatteryParameters {
  double cells = 3;
  double capacity_Ah = 2.2;   ///< of one cell, as all carry the same current [A h]
  double resistance = 0.025;  ///< inside the whole pack, its wires included [ohm]
  /// Lowest voltage under load of one cell: the speed controller gives less rather than
  /// go below it [V].
  double cutoff = 3.2;
  /// Voltage of one cell without load, at charges 0, 0.1 ... 1 [V]; linear in between.
  std::array<double, 11> open_circuit = {3.27, 3.68, 3.73, 3.77, 3.79, 3.82,
                                         3.87, 3.93, 4.00, 4.09, 4.20};
};

/// What must hold for a battery.
std::vector<ParameterError> errors(const BatteryParameters& parameters);

/// A battery under a load of constant power. Its state is the vehicle's `Energy`.
///
///   P = U I,  U = U0(charge) - R I   =>   I = (U0 - sqrt(U0^2 - 4 R P)) / (2 R)
///   charge' = -I / capacity
///
/// The maximum that it gives is the least of: the power at the cut-off voltage, the power
/// at half the open-circuit voltage (the largest there is), and what empties it within
/// the step. In every step U0 I dt is exactly what the load takes and what heats the
/// battery (P dt + R I^2 dt); U0 is that of the step's beginning.
/// Valid: no temperature, no slow recovery of the voltage, no ageing.
class Battery {
 public:
  explicit Battery(const BatteryParameters& parameters);

  /// Takes `power` [W] for `dt` [s]; sets charge, voltage and power of `energy`.
  /// @returns  the share of `power` that it gives, from 0 to 1: below 1 when the battery
  ///           cannot; 0 when it is empty or has failed, whatever is asked.
  /// Cost: below 20 ns.
  double draw(Energy& energy, const Faults& faults, double power, double dt) const;

  /// The same for a load that says its current [A], as a motor at a given voltage does.
  /// @returns  the share of `current` that it gives.
  double draw_current(Energy& energy, const Faults& faults, double current,
                      double dt) const;

  /// Voltage without load [V].
  double open_circuit(double charge) const;

  /// The maximum that it gives at this charge [W].
  double max_power(double charge) const;

  /// How long it gives the power drawn now [s], until empty or at its cut-off; infinity
  /// when no power is drawn. The power of one step jumps about: for an estimate of the
  /// flight time left, put its mean over some seconds in `energy.power`.
  double endurance(const Energy& energy) const;

 private:
  double current_for(double open_circuit, double power) const;
  double max_current(double open_circuit) const;
  double min_open_circuit(double power) const;
  void take(Energy& energy, double open_circuit, double current, double dt) const;

  std::array<double, 11> open_circuit_;  // of the pack [V]
  double resistance_;                    // [ohm]
  double inverse_resistance_;
  double capacity_;  // [C]
  double inverse_capacity_;
  double cutoff_;  // of the pack [V]
};

/// Current [A] that gives the power drawn now, as a battery monitor shows it.
inline double current(const Energy& energy) {
  return energy.voltage > 0 ? energy.power / energy.voltage : 0;
}

}  // namespace skein::asset
