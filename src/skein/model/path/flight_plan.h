// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/flight_plan.h"
#include "skein/data/vehicle/plan.h"

namespace skein::model {

/// Where a flight is, and how it moves.
struct FlightMoment {
  Vec3 p_N = Vec3::Zero();  ///< [m]
  Vec3 v_N = Vec3::Zero();  ///< velocity over ground [m/s]
  double heading = 0;       ///< of the air-relative velocity, not wrapped [rad]
};

/// The motion `t` seconds after the element's start, in closed form. With airspeed V,
/// turn rate r, heading h and wind w
///
///   p(t) = p + w t + V/r (sin(h + r t) - sin h,  cos h - cos(h + r t))
///
/// (north, east), p + w t + V t (cos h, sin h) without a turn; the altitude changes by
/// c t + a t^2 / 2. Outside of [0, duration] the element goes on.
FlightMoment moment(const FlightElement& element, double t);

/// Position only; see `moment`.
Vec3 position(const FlightElement& element, double t);

/// The motion at the end of the element.
FlightMoment end_of(const FlightElement& element);

/// The motion at a time of the run's clock; before the start and after the end of the
/// plan the first and the last element go on. Fails: Bug when the plan is empty.
/// Cost: logarithmic in the elements.
FlightMoment moment_at(const FlightPlan& plan, double time);

double start_of(const FlightPlan& plan);     ///< [s]; Fails: Bug when it is empty
double end_time_of(const FlightPlan& plan);  ///< [s]; Fails: Bug when it is empty
double duration(const FlightPlan& plan);     ///< [s]; 0 when it is empty

/// Horizontal length over ground of an element [m], to 1e-9 of it. A turn in wind is an
/// elliptic integral; it is summed by Gauss's rule over at most a quarter turn at a time.
double ground_length(const FlightElement& element);
double ground_length(const FlightPlan& plan);  ///< [m]

/// How finely a plan is sampled: steps within turns and on straights, neither of more
/// than these. Every element's start and end is a sample.
struct SamplingSteps {
  double turn = 0.2;        ///< change of heading [rad]
  double straight = 1e300;  ///< time [s]
};

/// Points with velocities for an autopilot (FollowPlan): denser in turns. The cubic curve
/// through them is within V/r (r h)^4 / 384 of the elements for steps of h seconds:
/// 0.2 rad in turns of 100 m are 0.4 mm. Where the velocity jumps from an element to the
/// next there is a sample 0.1 s before, so that the curve turns there and not all along.
Plan sample(const FlightPlan& plan, const SamplingSteps& steps = {});

/// The plan moved to another start time.
FlightPlan starting_at(FlightPlan plan, double start);

/// Adds `next` to the end of `plan`, moved in time to where that ends.
void append(FlightPlan& plan, FlightPlan next);

}  // namespace skein::model
