// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/asset/body/energy_source.h"
#include "skein/layer/asset/fixed_wing/parameters.h"

namespace skein::asset {

/// What drives a fixed wing, with its store of energy; the laws stand at ElectricMotor
/// and PistonEngine. How fast it runs is one number, its `spin`: the rotor speed [rad/s]
/// of an electric motor, the share of its power of a piston engine.
class Engine {
 public:
  explicit Engine(const Propulsion& propulsion);

  struct Output {
    double thrust = 0;  ///< [N]
    double torque = 0;  ///< that the propeller takes [N m]
  };

  /// What a spin gives.
  /// @param forward  velocity of the air along the shaft [m/s]; below 0 counts as 0.
  Output output(double spin, double forward, double density) const {
    const double V = std::max(0.0, forward);
    if (kind_ == Kind::kElectric) {
      const double thrust = spin * (t2_ * spin + t1_ * V) + t0_ * V * V;
      const double torque = spin * (q2_ * spin + q1_ * V) + q0_ * V * V;
      return {density * std::max(0.0, thrust), density * std::max(0.0, torque)};
    }
    if (kind_ == Kind::kPiston)
      return {efficiency_ * power(spin, V, density) / std::sqrt(V * V + V0_ * V0_), 0};
    return {};
  }

  /// Power drawn [W]: from the battery, or at the shaft of a piston engine.
  double power(double spin, double forward, double density) const;

  /// The spin that a throttle leads to.
  /// @param voltage  of the battery [V]; of no matter to a piston engine.
  double target(double throttle, double voltage, double forward, double density) const;

  double lag() const { return lag_; }
  bool exists() const { return kind_ != Kind::kNone; }
  const EnergySource& source() const { return source_; }

  /// What is on board at the start.
  Energy full() const;

  // For trims, all with a full battery.

  /// The spin that gives a thrust; 0 for none or less.
  double spin_for(double thrust, double forward, double density) const;

  /// The throttle that keeps a spin; above 1 when it cannot be kept.
  double throttle_for(double spin, double forward, double density) const;

 private:
  enum class Kind { kNone, kElectric, kPiston };

  Kind kind_ = Kind::kNone;
  double lag_ = 0;
  EnergySource source_;
  // Electric: thrust / density = t2 W^2 + t1 V W + t0 V^2, torque alike.
  double t0_ = 0, t1_ = 0, t2_ = 0, q0_ = 0, q1_ = 0, q2_ = 0;
  double K_ = 0, resistance_ = 0, no_load_current_ = 0;
  // Piston.
  double power_max_ = 0, efficiency_ = 0, V0_ = 0;
};

}  // namespace skein::asset
