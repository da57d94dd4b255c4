// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/airframe.h"
#include "skein/geo/vec.h"

namespace skein::autopilot {

/// Gains of FixedWingControl. They are bandwidths and accelerations, not deflections:
/// what a surface does is the airframe's business, so the same gains fit a glider of 0.9
/// kg and an aircraft of 600 kg.
struct FixedWingGains {
  // Roll.
  double roll_gain = 4;           ///< roll rate per roll error [1/s]
  double roll_rate_gain = 5;      ///< roll acceleration per rate error [1/s]
  double roll_rate_integral = 8;  ///< and per its integral [1/s^2]
  double roll_rate_limit = 1.6;   ///< [rad/s]
  double bank_gain = 5;  ///< rate of the bank aimed at per difference to the demand [1/s]
  double bank_rate_limit = 0.9;  ///< of it [rad/s]
  double bank_acceleration = 6;  ///< and of its rate [rad/s^2]
  // Pitch.
  double pitch_gain = 3.5;         ///< pitch rate per pitch error [1/s]
  double pitch_rate_gain = 5;      ///< pitch acceleration per rate error [1/s]
  double pitch_rate_integral = 8;  ///< and per its integral [1/s^2]
  double pitch_rate_limit = 0.8;   ///< [rad/s]
  double load_limit = 3;           ///< largest load factor asked for
  double lift_reserve =
      1.3;  ///< maximum lift demanded, over the weight at the minimum airspeed
  double flare_reserve = 1.6;  ///< the same, touching down
  // Yaw.
  double yaw_rate_gain = 2;     ///< yaw acceleration per rate error [1/s]
  double sideslip_gain = 1;     ///< yaw acceleration per sine of sideslip [1/s^2]
  double run_heading_gain = 2;  ///< yaw rate per heading error on the ground [1/s]
  double align_gain = 6;       ///< rudder channel per heading error at touch-down [1/rad]
  double align_rate_gain = 6;  ///< yaw acceleration per yaw rate meanwhile [1/s]
  // Energy.
  double height_gain = 0.8;       ///< climb rate per height error [1/s]
  double airspeed_gain = 0.5;     ///< acceleration per airspeed error [1/s]
  double energy_rate_gain = 0.6;  ///< throttle per error of the energy rate, in units of
                                  ///< the throttle that makes up for it in level flight
  double energy_integral = 0.4;   ///< and per its integral [1/s]
  double balance_gain = 0.5;      ///< path angle per error of the balance of energies, in
                                  ///< units of the angle that makes up for it
  double balance_integral = 0.4;  ///< and per its integral [1/s]
  double gust_filter = 1.2;  ///< gusts along the path slower than this count as airspeed
                             ///< [rad/s]; at 15 m/s of cruise, less the faster it is
  double airspeed_filter = 5;        ///< bandwidth of airspeed and its rate [rad/s]
  double vertical_acceleration = 7;  ///< bounds the rate of the demanded pitch [m/s^2]
  double throttle_rate = 1.5;        ///< largest change of throttle [1/s]
  double turn_drag = 0.35;  ///< induced drag over drag in level flight at cruise, for the
                            ///< throttle in turns
  // Take-off and landing.
  double climb_out_bank = geo::radians(20);  ///< largest bank [rad]
  double flare_bank = geo::radians(6);       ///< largest bank [rad]
};

/// What the laws need of airframe and gains, worked out once; one may serve many
/// vehicles.
struct FixedWingSetup {
  FixedWingSetup(const FixedWingAirframe& airframe, const FixedWingGains& gains);

  FixedWingGains gains;
  FixedWingAirframe airframe;  ///< with assumed values in place of those not known
  double gust_bandwidth;       ///< of gust_filter [rad/s]
  double bank_tangent;         ///< of the bank limit
  double lift_off;        ///< airspeed that carries it in the attitude it stands in [m/s]
  double alpha_per_load;  ///< angle of attack for one g at cruise, from zero lift [rad]
  /// Throttle per specific power [s/m]. It is that above level flight, below as well: a
  /// propeller stops pulling long before the throttle is shut.
  double throttle_slope;
};

}  // namespace skein::autopilot
