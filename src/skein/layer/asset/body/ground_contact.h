// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/asset/body/parameter_error.h"
#include "skein/role/plant.h"

namespace skein::asset {

/// What a vehicle stands on, and what breaks it. The defaults are skids all around, as
/// under a multirotor.
struct GroundContactParameters {
  double sink_limit = 2.5;  ///< touching down faster than this breaks it [m/s]
  double speed_limit = 3;   ///< horizontal speed that trips it over [m/s]; large = never
  double tilt_limit = 0.6;  ///< at touch, between the body's down and down [rad]
  double friction_along = 0.6;   ///< coefficient along the body: wheels 0.03 to 0.1
  double friction_across = 0.6;  ///< coefficient across the body
  double brake_friction = 0;     ///< on top along the body at full brake; 0 = no brakes
  double rest_pitch = 0;         ///< pitch at which it stands [rad]
  double levelling = 0.1;        ///< time constant of coming level [s]
  /// How the nose falls when it is above the rest pitch, and so how hard it is to raise
  /// in the take-off run: mass times the distance of the main wheels behind the centre of
  /// gravity over the inertia about the right axis [rad/m]. Negative: it stands on feet
  /// all around, which hold its pitch as they hold its roll.
  double nose_fall = -1;
  /// Turn rate that the ground stops per vertical speed that it stops [rad/m]: friction
  /// times the distance of the feet from the middle times mass over inertia about down.
  double yaw_grip = 10;
  double steering = 0;  ///< turn per distance that wheels make at full rudder [rad/m]
};

/// What must hold for these.
std::vector<ParameterError> errors(const GroundContactParameters& parameters);

/// What the ground at `ground_msl` [m] does to a vehicle at or below it, in one step.
///
/// The vehicle is put on the ground and loses its downward speed s. That takes an impulse
/// of s per mass; friction gives at most `friction` times as much against the horizontal
/// motion, along and across the body each (Coulomb). So a vehicle that gravity presses
/// down by (g - lift / mass) dt in each step is braked by friction (g - lift / mass), and
/// what still carries half its weight with the wings is braked half as much. Likewise the
/// wheels' impulse turns the nose down (nose_fall) and stops turning (yaw_grip). Roll
/// goes to 0, and a pitch below rest to rest, in the time `levelling`.
///
/// @param brake  how far the brakes are on, from 0 to 1.
/// @param steer  turn per distance that the wheels are set to [rad/m], clockwise
///               positive; the yaw rate is pulled towards steer times the speed along the
///               body.
/// @returns      kCrash when a limit is passed at the touch, with the state as it hit;
///               the speed limit counts only when it comes from the air.
/// Valid: level ground at that height; no spring, no bounce.
Contact touch_ground(const GroundContactParameters& parameters, VehicleState& state,
                     double ground_msl, double dt, double brake = 0, double steer = 0);

}  // namespace skein::asset
