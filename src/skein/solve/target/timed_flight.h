// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/role/path_planner.h"

namespace skein::solve {

/// From where, to where, and with what.
struct TimedLeg {
  FlightState from, to;
  double start = 0;  ///< [s]
  FlightLimits limits;
  Vec2 wind = Vec2::Zero();  ///< velocity of the air over ground [m/s]
  /// Whether airspeeds from `slowest` to `fastest` are used, else cruise alone.
  bool any_airspeed = true;
};

enum class TimedStatus : std::uint8_t {
  kFound,
  kTooEarly,      ///< before the earliest time
  kGap,           ///< between two times that can be met
  kNoConnection,  ///< wind too strong for all airspeeds, or no climb rate
};

/// A flight that arrives at a time.
struct TimedFlight {
  TimedStatus status = TimedStatus::kNoConnection;
  FlightPlan plan;      ///< empty unless found
  double airspeed = 0;  ///< [m/s]
  double earliest = 0;  ///< time of the first arrival that was found possible [s]
  double next = 0;  ///< the first time from the asked one on that was found possible [s]
};

/// The earliest arrival found over all allowed airspeeds [s]; infinite when there is no
/// path.
/// Slower flight turns in less room (same bank), so the fastest is not always first
/// there.
double earliest_arrival(const TimedLeg& leg);

/// A flight that is there at `time`, to 1e-9 of its duration: at the airspeed nearest to
/// cruise whose quickest connection takes just that long; where even the slowest is too
/// early, a detour at that airspeed (model/connection/arrival.h). The altitude changes
/// evenly.
TimedFlight arrive_at(const TimedLeg& leg, double time);

}  // namespace skein::solve
