// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/role/path_planner.h"
#include "skein/solve/target/moving_target.h"

namespace skein::solve {

/// How an aircraft stays with a target that is slower than it can fly.
enum class OrbitKind : std::uint8_t {
  kCircle,  ///< at one distance from it, around and around
  kWeave,   ///< along its track, in S-turns that take as long as the target does
};

enum class OrbitSide : std::uint8_t { kEither, kClockwise, kAnticlockwise };

/// What shall be orbited, and by whom.
struct OrbitQuery {
  OrbitKind kind = OrbitKind::kCircle;
  MovingTarget target;                  ///< a point that stays is one with velocity 0
  double radius = 150;                  ///< of the circle [m]
  OrbitSide side = OrbitSide::kEither;  ///< seen on the map
  double tolerance = 1;       ///< largest error of the distance on the circle [m]
  double duration = 300;      ///< with the target, after the path to it [s]
  double altitude_msl = 100;  ///< [m]
  double start_time = 0;      ///< [s]
  FlightState start;
  FlightLimits limits;       ///< airspeed is preferred, slowest and fastest are allowed
  Vec2 wind = Vec2::Zero();  ///< velocity of the air over ground [m/s]
};

enum class OrbitOutcome : std::uint8_t {
  kPlanned,
  kOutsideTolerance,  ///< planned, but the error is larger: the target turns too sharply
  kTargetTooFast,     ///< faster through the air than the aircraft
  kRadiusTooSmall,    ///< see `min_radius`
  kNotReached,        ///< no path to the target was found
  kWindTooStrong,     ///< at or above the fastest airspeed
  kBadTarget,
  kBadOrbit,     ///< radius, tolerance or duration
  kBadAircraft,  ///< limits, start, altitude
};

/// The word for an outcome, as files and messages have it.
std::string_view name_of(OrbitOutcome outcome);

/// An orbit, planned.
struct OrbitResult {
  OrbitOutcome outcome = OrbitOutcome::kBadOrbit;
  std::string reason = {};   ///< for people; empty when planned
  FlightPlan plan;           ///< the path to the target and the orbit
  double airspeed = 0;       ///< of the plan [m/s]
  double entry_time = 0;     ///< when the orbit begins [s]
  double min_radius = 0;     ///< of a circle at any allowed airspeed [m]
  double largest_error = 0;  ///< of the distance to the target, on a circle [m]
  double nearest = 0;        ///< distance to the target after the entry [m]
  double farthest = 0;       ///< [m]
};

/// Plans the quickest path to an orbit around a target, and the orbit.
///
/// *Circle.* In the frame of the target the aircraft flies a circle in the relative wind
/// w - v_target (standoff.h). It is made of turns at constant rate, shorter and shorter
/// ones until the distance is within the tolerance. Where a track changes its velocity
/// the circle is left, and found again. The path is the quickest one onto a tangent of
/// the circle, over all places of it.
///
/// *Weave.* With c = v_target - w turns from heading c - A to c + A and back advance at
///
///   V sin(A) / A = |c|
///
/// so that the aircraft is over the target after each turn, exactly, and never further
/// from it than `farthest`. The turns are as tight as they can be. Where a track changes
/// its velocity a detour of the right length meets the target again.
OrbitResult plan_orbit(const OrbitQuery& query);

/// The half angle A of S-turns that advance at `ratio` = |c| / V: sin(A) / A = ratio.
/// @param ratio  0 to 1.
/// @returns      pi to 0 [rad].
double weave_angle(double ratio);

}  // namespace skein::solve
