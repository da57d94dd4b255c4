// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/data/vehicle/airframe.h"
#include "skein/layer/asset/body/battery.h"
#include "skein/layer/asset/body/ground_contact.h"
#include "skein/layer/asset/body/parameter_error.h"

namespace skein::asset {

/// A multirotor of up to 8 equal rotors in one plane. Rotor numbers hold at 1.225 kg/m^3.
/// The defaults are a quadrotor of 1.5 kg with 10-inch propellers.
struct MultirotorParameters {
  double mass = 1.5;  ///< [kg]
  Inertia inertia{0.018, 0.018, 0.032, 0, 0, 0};

  // Rotors
  /// Where they are; channel k drives rotor k. Default: X of 0.25 m arms; front right,
  /// back left, front left, back right.
  std::vector<RotorPlace> rotors = {{{0.177, 0.177}, 1},
                                    {{-0.177, -0.177}, 1},
                                    {{0.177, -0.177}, -1},
                                    {{-0.177, 0.177}, -1}};
  double thrust_factor = 1.36e-5;  ///< thrust over speed^2 [N s^2]
  double torque_factor = 2.37e-7;  ///< drag torque over speed^2 [N m s^2]
  double rotor_radius = 0.127;     ///< [m]
  double rotor_inertia = 7e-5;     ///< of one, with its motor's bell [kg m^2]
  double fastest_rotor = 780;      ///< speed at full throttle [rad/s]
  double motor_lag = 0.04;         ///< time constant of the speed [s]

  // Air
  /// Force over rotor speed and air speed in the rotor's plane, of one rotor [N s^2/m].
  double rotor_drag = 1.2e-4;
  /// The same along the axis: thrust lost when climbing, won when sinking [N s^2/m].
  double axial_drag = 4e-4;
  /// Drag areas (coefficient times area) of the body seen along its axes [m^2].
  Vec3 drag_area{0.015, 0.015, 0.04};
  double turn_drag = 1e-3;  ///< moment of the body over turn rate^2 [N m s^2]

  // Power
  double efficiency = 0.75;      ///< of motor and speed controller
  double induced_factor = 1.15;  ///< induced power over that of an ideal disc
  double standing_power = 5;     ///< electronics [W]
  BatteryParameters battery{4, 5.0, 0.02};

  GroundContactParameters ground;

  // What it is flown with
  double tilt_limit = 0.6;  ///< [rad]
  double cruise = 10;       ///< horizontal airspeed [m/s]
  double fastest = 16;      ///< [m/s]
  double climb_rate = 4;    ///< [m/s]
  double sink_rate = 2.5;   ///< [m/s]
};

/// What must hold for these. Among others: the rotors can hold the weight and turn the
/// airframe about all three axes, and `fastest` can be flown within `tilt_limit`.
std::vector<ParameterError> errors(const MultirotorParameters& parameters);

/// Those of errors() that a plant cannot do without: numbers that are impossible one by
/// one. The others say that it would fly badly, as one with errors in its parameters may.
std::vector<ParameterError> number_errors(const MultirotorParameters& parameters);

}  // namespace skein::asset
