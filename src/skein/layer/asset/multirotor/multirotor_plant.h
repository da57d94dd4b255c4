// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/asset/body/battery.h"
#include "skein/layer/asset/body/rigid_body.h"
#include "skein/layer/asset/multirotor/multirotor_parameters.h"
#include "skein/layer/asset/multirotor/rotor_set.h"
#include "skein/role/plant.h"

namespace skein::asset {

/// Attitude and rotor speeds of steady flight.
struct MultirotorTrim {
  Quat q_NB = Quat::Identity();
  RotorSpeeds rotors{};  ///< [rad/s]
  double power = 0;      ///< electrical [W]
};

/// A rigid body under rotors of first-order lag.
///
///   w_i' = (throttle_i w_max - w_i) / lag                                   rotor speed
///   F_i = -w_i diag(d, d, a) v_i - (0, 0, k w_i^2)                rotor drag and thrust
///   F = sum F_i - rho/2 |v| diag(areas) v                                      and body
///   M = sum r_i x F_i + (0, 0, c sum s_i w_i^2)                   arms, torque of rotors
///       + J (q, -p, 0) sum s_i w_i + (0, 0, J sum s_i w_i')             rotors' inertia
///       - turn_drag |w| w                                                          body
///
/// v is the velocity through the air in B, v_i = v + w x r_i that of rotor i, w = (p, q,
/// r) the turn rate: through the air in all but the terms of inertia. k, c, d, a and
/// turn_drag grow with density. Rotor speeds are solved exactly within the step, the body
/// by RK4, so the error is of order dt^4 as long as controls are constant. Rotor drag is
/// linear as in [Mahony12]: for speeds far below those of the tips.
///
/// Power of the rotors by momentum theory and blade elements [Leishman06] ch. 2 and 5,
/// for the whole thrust T of n rotors of area A, with climb speed v_c = -v_z through the
/// discs and v_xy along them:
///
///   P = kappa T v_i + T v_c + c_0 sum w_i^3 (1 + 4.65 (v_xy / (w_i radius))^2)
///   v_i^2 (v_xy^2 + (v_c + v_i)^2) = v_h^4,   v_h^2 = T / (2 rho A n)
///   c_0 = c - kappa k^(3/2) / sqrt(2 rho A): hovering takes c w^3 a rotor
///
/// P over `efficiency`, and the electronics, load the battery. Where it cannot give that,
/// the rotors slow down to what it can.
/// Left out: blade flapping moments, vortex ring state, ground effect, wake of one rotor
/// on another, energy to spin rotors up.
/// VehicleState::actuators are the rotors' speeds [rad/s]. A dead rotor slows down to
/// stand, with its lag; a stuck one keeps its speed.
class MultirotorPlant final : public Plant {
 public:
  /// The parameters must be without number_errors().
  explicit MultirotorPlant(const MultirotorParameters& parameters);

  FlightLimits limits() const override;
  Airframe airframe() const override;
  /// In the air it hovers over ground in the wind.
  VehicleState start(const VehicleStart& start) const override;
  /// Takes Actuators: throttles from 0 to 1; what is no number counts as 0.
  void step(VehicleState& state, const Control& control, const Air& air,
            double dt) const override;
  Contact touch(VehicleState& state, double ground_msl, double dt) const override;

  /// Steady straight flight at a velocity through the air [m/s], with a heading [rad].
  /// Rotors beyond their limits are set to them: then it is steady no more.
  MultirotorTrim trim(const Vec3& v_AB_N, double heading, double density = 1.225) const;

  /// Power from the battery [W] with these rotors in flow v_AB_B [m/s].
  double power(const RotorSums& rotors, const Vec3& v_AB_B, double density) const;

 private:
  // The air as the vehicle meets it.
  struct Flow {
    Vec3 v_B;  // velocity through it [m/s]
    Vec3 w_B;  // turn rate through it [rad/s]
    double density;
  };
  // Without thrust and its torque, and without what inertia does.
  Loads drag(const RotorSums& rotors, const Flow& flow) const;
  Loads loads(const RotorSums& rotors, double spin_rate, const Flow& flow,
              const Vec3& w_NB_B) const;
  RotorSpeeds targets(const VehicleState& state, const Actuators& throttles,
                      double share) const;

  MultirotorParameters parameters_;
  RigidBody body_;
  RotorSet rotors_;
  Battery battery_;
  double disc_area_;       // of all rotors [m^2]
  double profile_factor_;  // c_0 [N m s^2]
};

}  // namespace skein::asset
