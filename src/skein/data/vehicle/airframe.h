// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>
#include <vector>

#include "skein/geo/vec.h"

namespace skein {

/// A plant that holds its own attitude: it takes a FlightCommand.
struct SelfStabilised {
  double span = 0;  ///< of its wing [m]; 0 = not known
};

/// A fixed wing that takes Actuators (see data/vehicle/control.h), as its autopilot must
/// know it.
struct FixedWingAirframe {
  double mass = 0;        ///< [kg]
  double span = 0;        ///< of the wing [m]; 0 = not known
  double slowest = 0;     ///< minimum airspeed to fly at: stall with its reserve [m/s]
  double cruise = 0;      ///< airspeed [m/s]
  double fastest = 0;     ///< [m/s]
  double bank_limit = 0;  ///< [rad]
  double pitch_up = 0;    ///< largest pitch angle [rad]
  double pitch_down = 0;  ///< minimum pitch angle, negative [rad]
  double climb_rate = 0;  ///< largest, at cruise and full throttle, with reserve [m/s]
  double sink_rate = 0;   ///< largest, motor idle at cruise, with reserve [m/s]
  // Level flight at cruise, sea level:
  double trim_alpha = 0;     ///< angle of attack [rad]
  double trim_elevator = 0;  ///< channel
  double trim_throttle = 0;  ///< channel
  bool rudder = true;        ///< has one
  bool motor = true;         ///< has one
  double roll_friction = 0;  ///< of the ground along the body, over weight; 0 = not known
  double rest_pitch = 0;     ///< at which it stands on the ground [rad]
  double steering = 0;       ///< turn per distance of its wheels at full rudder [rad/m]
  bool hand_launched = false;  ///< its crew throws it, once its motor runs
  double brake_friction = 0;   ///< on top at full brake; 0 = it has no brakes
  // How it answers in that flight, for gains of its own. 0 = not known.
  double aileron_power = 0;    ///< roll acceleration at full aileron [rad/s^2]
  double roll_damping = 0;     ///< roll deceleration over roll rate [1/s]
  double elevator_power = 0;   ///< pitch acceleration at full elevator up [rad/s^2]
  double pitch_damping = 0;    ///< pitch deceleration over pitch rate [1/s]
  double pitch_stiffness = 0;  ///< nose-down acceleration over angle of attack [1/s^2]
  double lift_slope = 0;       ///< lift over angle of attack, mass and airspeed [1/s]
  double rudder_power = 0;     ///< yaw acceleration at full rudder [rad/s^2]
};

/// One rotor, seen from above. Thrust goes up.
struct RotorPlace {
  Vec2 position = Vec2::Zero();  ///< forward, right of the centre of gravity [m]
  double spin =
      1;  ///< +1: its drag torque yaws the airframe clockwise, -1: counter-clockwise
};

/// A multirotor that takes Actuators: channel k is rotor k.
struct MultirotorAirframe {
  double mass = 0;              ///< [kg]
  Vec3 inertia = Vec3::Zero();  ///< about forward, right, down [kg m^2]
  std::vector<RotorPlace> rotors;
  double thrust_max = 0;    ///< of one rotor at full throttle [N]
  double torque_ratio = 0;  ///< drag torque over thrust [m]
  /// Thrust of a rotor is thrust_max throttle^exponent in steady state.
  double thrust_exponent = 2;
  double tilt_limit = 0;  ///< [rad]
  double cruise = 0;      ///< horizontal airspeed en route [m/s]
  double fastest = 0;     ///< [m/s]
  double climb_rate = 0;  ///< [m/s]
  double sink_rate = 0;   ///< [m/s]
  double motor_lag = 0;   ///< time constant of a rotor's speed [s]; 0 = not known
  double diameter = 0;    ///< of the circle that holds all rotors [m]; 0 = not known
};

/// What an autopilot is set up for.
using Airframe = std::variant<SelfStabilised, FixedWingAirframe, MultirotorAirframe>;

/// Its size across, as gusts feel it [m]; 0 = not known.
inline double span_of(const Airframe& airframe) {
  if (const auto* rotors = std::get_if<MultirotorAirframe>(&airframe))
    return rotors->diameter;
  if (const auto* wing = std::get_if<FixedWingAirframe>(&airframe)) return wing->span;
  return std::get<SelfStabilised>(airframe).span;
}

}  // namespace skein
