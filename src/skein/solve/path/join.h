// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/flight_plan.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/model/connection/connection.h"
#include "skein/role/path_planner.h"

namespace skein::solve {

/// How limits and wind say an aircraft moves at its cruise airspeed.
model::AirMotion motion_of(const FlightLimits& limits, const Vec2& wind);

/// The horizontal part of a flight state.
model::Pose pose_of(const FlightState& state);

/// The quickest flight from one state to another in open air: the exact connection in
/// wind, climbing or sinking evenly. When the climb takes longer than the connection,
/// full circles come first, as few as are enough.
///
/// Needs |wind| < airspeed and, for a change of altitude, a climb or sink rate above 0;
/// an empty plan when one of these does not hold, or when there is nowhere to go.
FlightPlan join(const FlightState& from, const FlightState& to,
                const FlightLimits& limits, const Vec2& wind, double start);

/// Straight flight over ground from one place to another at the altitude of `down`, with
/// the heading that makes the course good. Needs |wind| < airspeed. Without length it
/// takes no time.
FlightElement straight(const Vec2& from, const Vec2& to, double down,
                       const model::AirMotion& air, double start);

/// Where a plan ends.
FlightState end_state(const FlightPlan& plan);

}  // namespace skein::solve
