// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/data/vehicle/flight_plan.h"

namespace skein::model {

/// A time during which the climb rate is even or changes evenly.
struct ClimbPiece {
  double duration = 0;      ///< [s]
  double rate = 0;          ///< at its begin, upwards [m/s]
  double acceleration = 0;  ///< change of the rate [m/s^2]
};

/// How an altitude changes from a time on; level afterwards. With a bounded acceleration
/// a climb begins and ends level, by *vertical turns*: pieces whose rate changes evenly,
/// parabolas over time.
using ClimbProfile = std::vector<ClimbPiece>;

/// The least time for a change of altitude that begins and ends level [s]. With height h,
/// rate c and acceleration a
///
///   h/c + c/a  if h >= c^2/a,  2 sqrt(h/a) if the rate is not reached,  h/c if a is 0.
///
/// @param height        to be climbed or sunk, at least 0 [m].
/// @param rate          largest; infinite when it is 0 and the height is not [m/s].
/// @param acceleration  of the rate; 0: it changes at once [m/s^2].
double climb_time(double height, double rate, double acceleration);

/// The change of altitude that takes just a time with the smallest rate.
///
/// @param climb  upwards positive [m].
/// @param time   at least `climb_time` for the rate that may be used; where no rate is
///               enough, the acceleration is raised to what is needed [s].
ClimbProfile even_climb(double climb, double time, double acceleration);

/// The change of altitude that is soonest done; level without a rate.
/// @param climb  upwards positive [m].
ClimbProfile quickest_climb(double climb, double rate, double acceleration);

/// The plan with other altitudes: elements are cut where pieces of the profile meet, the
/// horizontal motion stays.
///
/// @param down     p_N.z() at the start of the plan [m].
/// @param profile  from the plan's start on. What goes on after the plan is left out.
FlightPlan climbing(const FlightPlan& plan, double down, const ClimbProfile& profile);

}  // namespace skein::model
