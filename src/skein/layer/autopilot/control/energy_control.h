// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/autopilot/control/fixed_wing_gains.h"
#include "skein/layer/autopilot/demand.h"

namespace skein::autopilot {

/// What the energy law looks at.
struct EnergyView {
  double altitude_msl = 0;   ///< [m]
  double climb_rate = 0;     ///< [m/s]
  double airspeed = 0;       ///< [m/s]
  double calm_airspeed = 0;  ///< of the velocity over ground less the mean wind [m/s]
  double load = 1;           ///< load factor of the turn
};

struct EnergyOutput {
  double pitch = 0;     ///< demanded [rad]
  double throttle = 0;  ///< 0 to 1
};

/// Height and airspeed by total energy: the throttle holds the sum of the rates of
/// potential and kinetic energy, the pitch their difference.
///
///   climb_d = climb_ff + k_h (h_d - h),      a_d = k_V (V_d - V)
///   E' = climb + V V'/g                      throttle: trim(E'_d) + k (E'_d - E') +
///   integral B' = w_p climb - w_k V V'/g              path angle: (B'_d + k (B'_d - B')
///   + integral) / V
///
/// Energies are divided by weight, so rates are in m/s. The pitch is the path angle and
/// the angle of attack that carries the load factor at this airspeed. Too slow, w goes
/// from (1, 1) to (0, 1): the pitch then serves the airspeed alone, with full throttle;
/// the same with the motor idle in a glide, and with it full in the climb after take-off.
/// Then the path angle is (E' - V a_d/g) / V.
///
/// V is the airspeed without fast gusts: that of the velocity over ground in the mean
/// wind, plus the low-passed difference to the measured one. So its rate is known without
/// the noise of gusts.
/// Reference: [Lambregts83].
class EnergyControl {
 public:
  /// To go on smoothly from a flight with this airspeed, pitch and throttle.
  void reset(const EnergyView& view, double pitch, double throttle);

  /// Somebody else flies, with this pitch and throttle: keeps up with the motion, and
  /// would go on smoothly from here.
  void follow(const FixedWingSetup& setup, const EnergyView& view, double pitch,
              double throttle, double dt);

  /// Without fast gusts [m/s].
  double airspeed() const { return speed_; }

  EnergyOutput step(const FixedWingSetup& setup, const FixedWingDemand& demand,
                    const EnergyView& view, double dt);

 private:
  // Rates of energy over weight [m/s], and how they are to be served.
  struct Rates {
    double energy = 0, energy_demand = 0;
    double balance = 0, balance_demand = 0;
    double turn_power = 0;     // that the bank costs
    double height_weight = 1;  // of the height in the balance
    double too_slow = 0;       // 0 to 1
    // Path angle times airspeed that energy not used for airspeed makes.
    double carried() const { return (1 - height_weight) * energy; }
  };

  void filter(const FixedWingSetup& setup, const EnergyView& view, double dt);
  Rates rates(const FixedWingSetup& setup, const FixedWingDemand& demand,
              const EnergyView& view, double speed) const;
  void move_throttle(const FixedWingSetup& setup, const FixedWingDemand& demand,
                     const Rates& rates, double dt);
  void move_pitch(const FixedWingSetup& setup, const FixedWingDemand& demand,
                  const EnergyView& view, const Rates& rates, double alpha, double speed,
                  double dt);

  double gust_ = 0;          // airspeed beyond the calm one, filtered [m/s]
  double speed_ = 0;         // filtered [m/s]
  double acceleration_ = 0;  // [m/s^2]
  double throttle_sum_ = 0;  // integral part of the throttle
  double path_sum_ = 0;      // of the path angle times airspeed [m/s]
  double pitch_ = 0;         // last demanded [rad]
  double throttle_ = 0;      // last
  bool fresh_ = true;        // the integrators are to be set so that nothing jumps
};

}  // namespace skein::autopilot
