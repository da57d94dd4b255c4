// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/manoeuvre.h"

namespace skein::reasoning {

/// The flight that a manoeuvre changes, and the conflict that it is about.
struct ConflictOfFlight {
  const FlightPlan& plan;
  const FlightLimits& limits;
  double begin = 0;         ///< the plan may be left from then on [s]
  double meets = 0;         ///< when the two come nearer than the separation [s]
  double closest_time = 0;  ///< when they are closest [s]
  double apart = 0;         ///< when they are apart again [s]
  Separation separation;    ///< that the two have to keep
};

/// The flight with the manoeuvre, from `begin` to the end of the plan, within the limits
/// and in the wind of the plan. The same input gives the same flight in every aircraft.
///
/// - Aside: the plan is left `lead` before the conflict; the flight passes beside where
///   the plan would be when they are closest, with the plan's heading, and goes to the
///   plan's end from there.
/// - Up, down: begun so late that it is level four seconds before the conflict, or `lead`
///   before it where that is earlier, until two seconds after it, then to the plan's end.
///   Sideways the plan is kept until then.
/// - Speed: from `begin` to where the plan is two seconds after the conflict, then at
///   cruise to its end. Turns take the radius of that airspeed at the same bank.
///
/// @returns  nothing where there is no time for it, or no such flight.
std::optional<FlightPlan> manoeuvred(const Manoeuvre& manoeuvre,
                                     const ConflictOfFlight& conflict);

/// Where an aircraft is, and how it moves over ground.
struct PresentMotion {
  Vec3 p_N = Vec3::Zero();  ///< [m]
  Vec3 v_N = Vec3::Zero();  ///< [m/s]
};

/// The flight that turns from where the aircraft is, as narrowly as it can, and goes
/// straight on, all of it level, then to the end of the plan.
/// @param present   the aircraft at `begin`.
/// @param change    of the heading, to the right [rad].
/// @param duration  of the turn and the straight part, the turn at most [s].
/// @returns  nothing where there is no such flight.
std::optional<FlightPlan> turned_on_flight(const ConflictOfFlight& conflict,
                                           const PresentMotion& present, double change,
                                           double duration);

/// The flight that turns at `begin` and flies on until a time [s], then to the end of the
/// plan.
/// @param change  of the heading, to the right [rad].
/// @returns  nothing where there is no such flight.
std::optional<FlightPlan> turned_flight(const ConflictOfFlight& conflict, double change,
                                        double until);

}  // namespace skein::reasoning
