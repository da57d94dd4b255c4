// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/airframe.h"

namespace skein::autopilot {

/// Gains of MultirotorControl: bandwidths and accelerations, not torques, so the same fit
/// small and large airframes.
struct MultirotorGains {
  // Position.
  double position_gain = 1;       ///< speed per horizontal error [1/s]
  double velocity_gain = 2.4;     ///< acceleration per speed error [1/s]
  double velocity_integral = 1;   ///< and per its integral [1/s^2]
  double height_gain = 1.3;       ///< climb rate per height error [1/s]
  double climb_gain = 4;          ///< acceleration per climb rate error [1/s]
  double climb_integral = 1.5;    ///< and per its integral [1/s^2]
  double hover_learning = 0.1;    ///< at which that integral becomes hover thrust [1/s]
  double acceleration_limit = 5;  ///< vertical [m/s^2]
  // Attitude. Where 0 stands the motors' lag says how fast is right.
  double rate_gain = 0;        ///< angular acceleration per rate error [1/s]; 0: by lag
  double rate_integral = 0.2;  ///< per its integral, over the square of rate_gain
  double rate_derivative = 0.02;  ///< angular acceleration per rate of the turn rates
  double derivative_filter = 60;  ///< bandwidth of that [rad/s]
  double tilt_gain = 0;           ///< turn rate per tilt error [1/s]; 0: by lag
  double heading_gain = 2;        ///< yaw rate per heading error [1/s]
  double yaw_rate_gain = 4;       ///< yaw acceleration per rate error [1/s]
  double tilt_rate_limit = 4;     ///< [rad/s]
  double yaw_rate_limit = 1.5;    ///< [rad/s]
  // Pilot.
  double manual_tilt_rate = 4;  ///< at full stick [rad/s]
  double manual_yaw_rate = 2;   ///< at full stick [rad/s]
};

/// What the laws need of airframe and gains, worked out once; one may serve many
/// vehicles.
struct MultirotorSetup {
  MultirotorSetup(const MultirotorAirframe& airframe, const MultirotorGains& gains);

  MultirotorAirframe airframe;
  double motor_lag;       ///< known or assumed [s]
  MultirotorGains gains;  ///< none is 0 for "by lag" any more
  /// Of what may be learnt as hover thrust over the nominal one: with either, the bounded
  /// vertical acceleration still brings it back.
  double min_scale, max_scale;
  double tilt_tangent;  ///< of the tilt limit
  double max_thrust;    ///< of all rotors [N]
};

}  // namespace skein::autopilot
