// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/base/result.h"
#include "skein/data/vehicle/control.h"
#include "skein/geo/local_frame.h"
#include "skein/geo/rotation.h"
#include "skein/geo/vec.h"

/// What programs with flight models exchange with an autopilot outside: FlightGear,
/// X-Plane. SI units here; each program has its own.
namespace skein::flight_model {

/// How the aircraft of a program moves.
struct FlightState {
  double time = 0;          ///< of the program's clock, which stands in its pauses [s]
  geo::Geodetic place;      ///< its height is above mean sea level
  Vec3 v_N = Vec3::Zero();  ///< over ground [m/s]
  Quat q_NB = Quat::Identity();  ///< attitude
  Vec3 w_NB_B = Vec3::Zero();    ///< rate of turn [rad/s]
  Vec3 wind_N = Vec3::Zero();    ///< velocity of the air over ground [m/s]
  double fuel = 1;               ///< left, from 0 to 1
  bool on_ground = false;
};

/// Whether all numbers are finite and such as an aircraft near the Earth can have.
/// Fails: kBadInput, naming the first that is not.
Result<void> check(const FlightState& state);

/// What the controls of the program's aircraft are to be: surfaces from -1 to 1, positive
/// where they roll right, bring the nose up or the nose right.
struct FlightControls {
  double aileron = 0;
  double elevator = 0;
  double rudder = 0;
  double throttle = 0;         ///< from 0 to 1
  double brake = 0;            ///< of the wheels, from 0 to 1
  std::optional<Vec3> wind_N;  ///< that the program's air is to have [m/s]
};

/// Actuators of a fixed wing (data/vehicle/control.h) as controls; bounded, what is not
/// finite counts as 0.
FlightControls controls_of(const Actuators& actuators);

}  // namespace skein::flight_model
