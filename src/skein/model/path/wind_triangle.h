// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/geo/vec.h"

namespace skein::model {

/// The heading that makes good a course over ground in a steady wind.
///
///   heading = course - asin(w_right / airspeed),  w_right = wind across the course
///
/// @param wind  velocity of the air over ground [m/s].
/// @returns     heading [rad, (-pi, pi]]; nothing when the crosswind is stronger than the
///              airspeed or the wind carries the aircraft backwards along the course.
std::optional<double> heading_for_course(double course, double airspeed,
                                         const Vec2& wind);

/// Radius over ground [m] that an aircraft can fly at every heading in a steady wind.
///
///   R = radius (1 + |wind| / airspeed)^2
///
/// Downwind the ground speed is largest; there the turn rate airspeed / radius gives the
/// ground path its smallest curvature.
///
/// @param radius  smallest turn radius in the air mass [m].
double ground_turn_radius(double radius, double airspeed, double wind_speed);

}  // namespace skein::model
