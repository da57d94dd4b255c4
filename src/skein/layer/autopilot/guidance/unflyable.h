// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/vehicle.h"

namespace skein::autopilot {

/// Why a vehicle cannot fly a command in a steady wind; nothing when it can.
///
/// Asked of every command: numbers finite; airspeed within [slowest, fastest]; the
/// standard air at its altitude, at that of every waypoint and instant of a plan, at
/// least as dense as `min_density`, and dense enough for its airspeed (else cruise):
/// slowest sqrt(1.225 kg/m^3 / density) is the minimum there, give or take 3 %. Then
///
/// - turns of a path, circles: the lateral acceleration that the turn needs over ground
///   at the slowest airspeed, V_g^2 / R / cos(drift angle), is at most that of the bank
///   limit a_max = airspeed^2 / turn_radius, at every course of the turn;
/// - straight lines, courses: some ground speed along them is left at the fastest
///   airspeed;
/// - plans: not empty, times grow, and at 16 instants of each segment: airspeed that
///   makes good its velocity, |v - wind|, within [slowest, fastest] give or take 3 %;
///   climb and sink within their limits, give or take 10 %; turns as above, at the plan's
///   own speed; climbs and turns as they are or on the mean of the second around;
/// - waypoints: at least one, at least one lap, legs no steeper than the vehicle climbs
///   and sinks at the slowest airspeed, and no two in a row above one another.
///
/// Vehicles that can hover (slowest = 0) turn on the spot: turns are not asked about.
/// Cost: linear in the command; no allocation unless there is a reason.
std::optional<std::string> unflyable(const AutopilotCommand& command,
                                     const FlightLimits& limits, const Vec2& wind);

/// That a number of a command for a course, place, circle or path, its altitude or its
/// airspeed is not finite; none when all are.
std::optional<std::string> not_finite(const AutopilotCommand& command);

}  // namespace skein::autopilot
