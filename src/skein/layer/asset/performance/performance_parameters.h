// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/asset/body/battery.h"
#include "skein/layer/asset/body/fuel_tank.h"
#include "skein/layer/asset/body/parameter_error.h"

namespace skein::asset {

/// An aeroplane as its performance figures describe it. The defaults are a light-sport
/// two-seater of Tecnam P2002 class with two on board.
struct PerformanceParameters {
  double mass = 528;  ///< without fuel [kg]

  // Air
  double wing_area = 11.5;         ///< [m^2]
  double zero_lift_drag = 0.0272;  ///< C_D0
  double induced_drag = 0.0635;    ///< K in C_D = C_D0 + K C_L^2
  double lift_max = 1.45;          ///< largest C_L
  double stall_reserve = 1.15;     ///< minimum airspeed over stall speed, at any bank

  // Engine and propeller
  double power = 73500;  ///< at the shaft, sea level [W]
  /// Power lost over density lost: P = power (1 - lapse (1 - density / 1.225)). Unblown
  /// piston engines 1.132 [Gagg34]; electric motors 0.
  double power_lapse = 1.132;
  double cruise_power = 0.9;  ///< share of the power at most used in level flight
  double idle_power = 0;      ///< share of the power that pushes at idle
  double propeller_efficiency = 0.88;  ///< at great speed
  /// Airspeed at which the propeller has half of that: thrust is efficiency P / (V +
  /// this) [m/s].
  double propeller_speed = 10;

  // Energy
  bool electric = false;  ///< flies on the battery, else on the tank
  FuelTankParameters tank{72, 6.4e-8, 3e-4};
  BatteryParameters battery{96, 100, 0.1};
  double motor_efficiency = 0.9;  ///< shaft power over battery power, when electric

  // What it is flown with
  double cruise = 50;         ///< airspeed [m/s]
  double slowest = 30;        ///< [m/s]
  double fastest = 64;        ///< [m/s]
  double bank_limit = 0.7;    ///< [rad]
  double roll_rate = 0.35;    ///< largest [rad/s]
  double acceleration = 1.5;  ///< largest along the path, in both directions [m/s^2]
  double airspeed_lag = 4;    ///< time constant of the airspeed [s]
  double climb_rate = 6;      ///< maximum demanded [m/s]
  double sink_rate = 6;       ///< maximum demanded [m/s]
};

/// What must hold for these. Among others: `slowest` is above the stall speed with its
/// reserve, and cruise can be held, both with full tank at sea level.
std::vector<ParameterError> errors(const PerformanceParameters& parameters);

/// Those of errors() that a plant cannot do without: numbers that are impossible one by
/// one. The others say that it would fly badly, as one with errors in its parameters may.
std::vector<ParameterError> number_errors(const PerformanceParameters& parameters);

}  // namespace skein::asset
