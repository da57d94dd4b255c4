// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/data/vehicle/vehicle.h"
#include "skein/role/path_planner.h"

namespace skein::solve {

/// Ranges of what is planned with; beyond them values are mistakes, and sums lose digits.
inline constexpr double kMaxCoordinate = 1e6;  ///< from the origin of the frame [m]
inline constexpr double kMaxTime = 1e8;        ///< of the run's clock [s]
inline constexpr double kLongestFlight = 1e6;  ///< [s]

/// Whether a place is finite and not off the map.
bool on_map(const Vec2& p);

/// What is wrong with a start or goal; empty when nothing is.
std::string state_error(const FlightState& state);

/// Whether a time of the run's clock can be planned with.
bool usable_time(double time);

/// What is wrong with the limits of an aircraft as planners of tasks use them (airspeed
/// 0.1 to 1000 m/s, turn radius 0.1 to 100,000 m, climb and sink rate); empty when
/// nothing is.
std::string limits_error(const FlightLimits& limits);

/// The same for the range of airspeeds: 0 <= slowest <= airspeed <= fastest,
/// the fastest at most ten times the airspeed.
std::string speeds_error(const FlightLimits& limits);

/// Whether the wind is too strong for an airspeed: at or above it, but for a millionth,
/// as flight against it would then take forever.
bool too_windy(double wind, double airspeed);

/// What is wrong with a climb of so many metres; empty when nothing is.
std::string climb_error(double climb, const FlightLimits& limits);

/// Words for a wind that no plan can be made in.
std::string too_strong(double wind, double airspeed);

}  // namespace skein::solve
