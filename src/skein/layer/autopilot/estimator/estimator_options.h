// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/geo/vec.h"

namespace skein::autopilot {

/// What the estimator assumes of its sensors and of the air. Densities are standard
/// deviations per root of bandwidth. The defaults fit the sensors' own.
struct EstimatorOptions {
  bool fixed_wing = true;  ///< flies without lasting side-slip: heading shows the wind
  double period = 0.1;     ///< between covariance steps and corrections [s]

  // Inertial unit.
  double gyro_noise = 2e-4;       ///< [rad/s/sqrt(Hz)]
  double gyro_bias_sd = 0.005;    ///< at the start [rad/s]
  double gyro_bias_walk = 2e-5;   ///< [rad/s/sqrt(s)]
  double gyro_scale_sd = 0.003;   ///< relative
  double accel_noise = 4e-3;      ///< [m/s^2/sqrt(Hz)]
  double accel_bias_sd = 0.1;     ///< at the start [m/s^2]
  double accel_bias_walk = 5e-4;  ///< [m/s^2/sqrt(s)]
  double accel_scale_sd = 0.003;  ///< of the scale: part of the bias, see docs

  // Satellite navigation, horizontal per axis; vertical errors are larger as the fix
  // states. The rest of what it states wanders slowly: a first-order Gauss-Markov error.
  double gnss_multipath_sd = 0.65;      ///< by the carrier's phase (RTK) 1 % of it [m]
  double gnss_multipath_time = 30;      ///< its correlation time [s]
  double gnss_noise_sd = 0.2;           ///< by the carrier's phase 1 % of it [m]
  double gnss_noise_time = 1;           ///< its correlation time [s]
  double gnss_correlation_time = 1800;  ///< of the rest [s]
  double gnss_lost_after = 2;           ///< without fix [s]
  double gnss_reset_after = 5;          ///< of rejected fixes: begin again from them [s]

  // Barometer: noise and a first-order Gauss-Markov error.
  double baro_noise = 0.3;              ///< white [m]
  double baro_bias_sd = 1.4;            ///< [m]
  double baro_correlation_time = 1200;  ///< [s]

  // Magnetometer.
  double magnetic_noise = 0.005;     ///< white, per axis, of the unit field
  double magnetic_bias_sd = 0.02;    ///< per axis, of the unit field
  double magnetic_bias_walk = 1e-5;  ///< [1/sqrt(s)]
  double declination = 0;            ///< of the field at the site [rad]

  // Air.
  double airspeed_noise = 0.3;        ///< white [m/s]
  double airspeed_scale_sd = 0.023;   ///< relative, all lasting errors of the pitot tube
  double airspeed_scale_walk = 1e-5;  ///< [1/sqrt(s)]
  double min_airspeed = 6;        ///< below it neither pitot nor side-slip count [m/s]
  double sideslip_sd = 0.02;      ///< that lasts for some seconds [rad]
  double anemometer_noise = 0.3;  ///< white, per axis [m/s]
  double wind_walk = 0.03;        ///< of the mean wind, per axis [m/s/sqrt(s)]
  double gust_sd = 1.5;           ///< at the start, then estimated [m/s]
  double min_gust_sd = 0.1;       ///< [m/s]
  double gust_length = 200;       ///< over which gusts are alike [m]
  double gust_memory = 120;       ///< of the estimated gust strength [s]

  double gate = 5;  ///< innovations beyond this many standard deviations are rejected
  double alignment_time = 2;  ///< at rest [s]
};

/// How well something is known: standard deviations.
struct NavAccuracy {
  double position = 0;  ///< per horizontal axis [m]
  double altitude = 0;  ///< [m]
  double velocity = 0;  ///< per axis [m/s]
  double tilt = 0;      ///< per axis [rad]
  double heading = 0;   ///< [rad]
  double wind = 0;      ///< of the mean wind, per axis [m/s]
};

}  // namespace skein::autopilot
