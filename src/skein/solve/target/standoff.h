// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/model/path/pose.h"
#include "skein/solve/target/moving_target.h"

namespace skein::solve {

/// Airspeed and the turn radius that goes with it at the same bank.
struct FlyingSpeed {
  double airspeed = 15;     ///< [m/s]
  double turn_radius = 60;  ///< in the air mass [m]
};

/// Share of the wind that airspeed keeps at least, for progress against it.
inline constexpr double kWindReserve = 1.05;

/// The turn radius at another airspeed and the same bank [m]: it grows with its square.
double turn_radius_at(double airspeed, const FlightLimits& limits);

/// The smallest circle around a target that can be flown at an airspeed V [m].
///
///   R = rho(V) (1 + W / V)^2,   rho(V) = rho (V / V_cruise)^2,   W = |w - v_target|
///
/// With course chi the relative speed is s = W_t + q, q = sqrt(V^2 - W_n^2), and the
/// heading chi - asin(W_n / V) turns at s^2 / (R q), most when the relative wind W is
/// from behind. Infinite when W >= V.
/// @param felt  W, the wind that somebody who moves with the target feels [m/s].
double min_standoff(double airspeed, const FlightLimits& limits, double felt);

/// The airspeed nearest to cruise at which a circle can be flown, from `slowest` to
/// `fastest`; nothing when there is none. It is kept 5 % above the wind over ground and
/// the felt one, so that there is some progress against them.
std::optional<FlyingSpeed> speed_for_circle(double radius, const FlightLimits& limits,
                                            double felt, double wind);

/// The smallest circle that any allowed airspeed can fly [m]; infinite when none can.
double min_standoff(const FlightLimits& limits, double felt, double wind);

/// A circle around a moving target.
struct Standoff {
  MovingTarget target;
  double radius = 100;       ///< [m]
  int side = 1;              ///< 1 clockwise on the map, -1 counter-clockwise
  Vec2 wind = Vec2::Zero();  ///< over ground [m/s]
  FlyingSpeed speed;
};

/// The place on the circle in direction `bearing` of the target at a time, with the
/// heading that flies along it.
model::Pose pose_on(const Standoff& standoff, double bearing, double time);

/// Flight along the circle from a pose on or near it, in elements no longer than `step`
/// seconds, level at `down`. Each element ends with the heading that flies along the
/// circle, a little inwards outside of it and outwards inside of it; turns are no tighter
/// than the turn radius.
FlightPlan along_circle(const Standoff& standoff, const model::Pose& from, double start,
                        double duration, double step, double down);

/// The largest difference between the distance to the target and the radius [m], at eight
/// points of each element.
double largest_error(const Standoff& standoff, const FlightPlan& plan);

}  // namespace skein::solve
