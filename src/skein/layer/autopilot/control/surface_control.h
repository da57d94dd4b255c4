// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/data/vehicle/control.h"
#include "skein/layer/autopilot/control/fixed_wing_gains.h"
#include "skein/layer/autopilot/control/tilt.h"
#include "skein/layer/autopilot/nav_state.h"

namespace skein::autopilot {

/// Attitude for the surfaces.
struct SurfaceDemand {
  double roll = 0;          ///< [rad]
  double roll_rate = 0;     ///< at which that changes [rad/s]
  double pitch = 0;         ///< [rad]
  double airspeed = 0;      ///< without noise, for the effect of surfaces [m/s]
  double lift_reserve = 1;  ///< maximum lift, over the weight at the minimum airspeed
  /// The ground carries it: no angle of attack is held for lift.
  bool carried = false;
  double extra_turn = 0;  ///< turn rate beyond that of a turn without sideslip [rad/s]
  /// Instead of without sideslip the nose is held along a course, from which it is off by
  /// this [rad], clockwise positive.
  std::optional<double> off_heading = std::nullopt;
};

/// The inner loops of a fixed wing: attitude to turn rates, turn rates to surfaces.
///
///   phi'_d = k (phi_d - phi) + ff,  theta'_d = k (theta_d - theta),  psi'_d = g
///   tan(phi)/V p_d = phi'_d - sin(theta) psi'_d q_d = cos(phi) theta'_d + cos(theta)
///   sin(phi) psi'_d r_d = cos(theta) cos(phi) psi'_d - sin(phi) theta'_d
///
/// then each surface gives the moment that holds its rate against damping and stiffness
/// (feed-forward), plus P and I of the rate error, over its effect at this dynamic
/// pressure. q_d is bounded so that the load factor stays below what the wing carries at
/// this airspeed (V^2 / slowest^2) and below the limit. Integrators stand while their
/// surface is at its end and the error drives it further.
/// Reference: [Beard12] section 6.
class SurfaceControl {
 public:
  /// Integrators as if `last` were the steady surfaces now.
  void reset();

  /// Writes aileron, elevator and rudder.
  void step(const FixedWingSetup& setup, const SurfaceDemand& demand, const NavState& nav,
            const Tilt& tilt, double dt, Actuators& out);

 private:
  double roll_sum_ = 0;   // channel
  double pitch_sum_ = 0;  // channel, nose up positive
};

}  // namespace skein::autopilot
