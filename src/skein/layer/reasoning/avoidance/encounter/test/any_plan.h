// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <rapidcheck.h>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {

inline double number(double low, double high) {
  return low + *rc::gen::inRange(0, 1000) / 999.0 * (high - low);
}

/// Where plans are drawn from.
struct AnyPlan {
  double latest_start = 0;         ///< [s]
  double reach = 0;                ///< to either side of the origin [m]
  double lowest = 0, highest = 0;  ///< at the start [m]
  double longest = 0;              ///< of one of five elements [s]
};

/// Straights, turns, climbs and vertical turns in wind, one after the other.
inline FlightPlan any_plan(const AnyPlan& of) {
  FlightPlan plan;
  FlightElement e;
  e.start = number(0, of.latest_start);
  e.p_N = {number(-of.reach, of.reach), number(-of.reach, of.reach),
           -number(of.lowest, of.highest)};
  e.heading = number(-3, 3);
  e.wind = {number(-8, 8), number(-8, 8)};
  for (int k = 0; k < 5; ++k) {
    e.airspeed = number(12, 25);
    e.duration = number(0.5, of.longest);
    e.turn_rate = *rc::gen::inRange(0, 2) == 0 ? 0 : number(-0.4, 0.4);
    e.climb_rate = number(-3, 3);
    e.climb_acceleration = *rc::gen::inRange(0, 3) == 0 ? number(-0.5, 0.5) : 0;
    plan.push_back(e);
    const model::FlightMoment end = model::end_of(e);
    e.p_N = end.p_N;
    e.heading = end.heading;
    e.start += e.duration;
  }
  return plan;
}

}  // namespace skein::reasoning
