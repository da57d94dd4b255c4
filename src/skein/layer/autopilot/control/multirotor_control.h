// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "skein/data/vehicle/pilot.h"
#include "skein/geo/rotation.h"
#include "skein/layer/autopilot/control/mixer.h"
#include "skein/layer/autopilot/control/multirotor_gains.h"
#include "skein/layer/autopilot/demand.h"
#include "skein/layer/autopilot/nav_state.h"

namespace skein::autopilot {

/// Flies a multirotor after a moving reference, by a cascade:
///
///   v_d = v_ff + k_p (p_d - p)                              bounded by the airframe
///   a_d = a_ff + k_v (v_d - v) + integral                   bounded by tilt and thrust
///   f   = a_d - g down: thrust T = m s |f|, direction of the rotors' axis u = f / |f|
///   w_d = k_t 2 sin(e/2) about (axis x u)  +  psi'_d down   e: tilt error
///   torque = J (k_w (w_d - w) + integral - k_d w') + w x J w
///
/// and the mixer. The tilt error is that of the rotors' axis alone, so a large error of
/// heading never slows the tilt. s is the hover thrust over the airframe's: the vertical
/// integral moves into it slowly, which learns weight, air density and battery.
///
/// Rotors that stand are left out of the mixer (set_standing): six or more rotors fly on
/// with less authority. With one of four standing the heading is given up: the airframe
/// spins, which brings the direction that can be steered to everywhere, and torques are
/// turned ahead by the angle it spins while rotors and rates follow (angle r (1/k_w +
/// lag/2)).
///
/// Outputs are finite and in range whatever the demand and the state are. If one of them
/// is not finite, the last output is held. Free of allocation, except where rotors begin
/// or cease to stand.
/// Reference: [Brescianini20] for the reduced attitude; [Mellinger11] for the cascade.
class MultirotorControl {
 public:
  explicit MultirotorControl(std::shared_ptr<const MultirotorSetup> setup);
  MultirotorControl(const MultirotorAirframe& airframe, const MultirotorGains& gains);

  /// Another law, or nobody, has flown: the next control() goes on from the state now.
  /// What was learnt about hover thrust and rates stays.
  void reset(const NavState& nav);

  /// New gains in flight, without a jump.
  void change(std::shared_ptr<const MultirotorSetup> setup);

  /// Bit k: rotor k gives nothing.
  void set_standing(std::uint8_t rotors);

  Actuators control(const MultirotorDemand& demand, const NavState& nav, double dt);

  /// Holds roll, pitch and yaw rate; throttle is the share of the airframe's thrust.
  Actuators stabilize(const AttitudeDemand& demand, const NavState& nav, double dt);

  /// Sticks say turn rates; throttle is the share of the airframe's thrust.
  Actuators manual(const PilotInput& sticks, const NavState& nav, double dt);

  /// What the pilot's sticks mean when stabilized: full stick is the tilt limit.
  AttitudeDemand attitude_for(const PilotInput& sticks) const;

  const MultirotorSetup& setup() const { return *setup_; }
  /// Hover thrust over mass times gravity, as learnt; what thin air costs is known.
  double hover_scale() const { return hover_scale_; }

 private:
  Vec3 acceleration_for(const MultirotorDemand& demand, const NavState& nav, double dt);
  double thin_air(double altitude_msl);
  Vec3 tilt_rates(const Vec3& up_B) const;
  void integrate_rates(const std::array<bool, 3>& limited, const Vec3& step);
  Actuators turn(const Vec3& rates, double thrust, const NavState& nav, double dt);

  std::shared_ptr<const MultirotorSetup> setup_;
  Mixer mixer_;
  std::uint8_t standing_ = 0;
  bool spins_ = false;                // the rotors left cannot hold the heading at all
  Vec3 velocity_sum_ = Vec3::Zero();  // integral part of the acceleration, in N [m/s^2]
  double hover_scale_ = 1;
  double air_altitude_ = 0, thin_air_ = 1;  // where the density was last looked up [m]
  Vec3 rate_sum_ = Vec3::Zero();            // of the angular acceleration [rad/s^2]
  Vec3 rates_ = Vec3::Zero();               // filtered, for the derivative [rad/s]
  Actuators last_;
  bool fresh_ = true;
};

}  // namespace skein::autopilot
