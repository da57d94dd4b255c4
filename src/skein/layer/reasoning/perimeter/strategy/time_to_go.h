// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/perimeter/fire.h"
#include "skein/data/perimeter/monitoring.h"

namespace skein::perimeter {

/// Time [s] that the aircraft needs to reach `place`, with its turn radius and in the
/// wind it believes in; infinite where that wind keeps it away. Any course on arrival.
double time_to_go(const AircraftStatus& aircraft, const Vec2& place);

/// The believed boundary point `time` [s] later, when nothing is observed in between.
BoundaryPoint carried_on(const BoundaryPoint& point, double time);

/// A boundary point as an aircraft finds it on arrival: fires move while one flies.
struct Meeting {
  BoundaryPoint point;  ///< at the time of arrival
  double t_go = 0;      ///< [s]; infinite where the wind, or the fire's speed, forbid it
};

/// Where and when the aircraft meets the moving point: two corrections of the time to go,
/// which leave less than the square of (rate / airspeed) of the first flight's error.
Meeting meet(const AircraftStatus& aircraft, const BoundaryPoint& point);

/// A time [s] that `meet(aircraft, point).t_go` is not below, without planning a flight.
double min_time_to_meet(const AircraftStatus& aircraft, const BoundaryPoint& point);

}  // namespace skein::perimeter
