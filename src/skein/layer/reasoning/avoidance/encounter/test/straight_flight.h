// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/flight_plan.h"

namespace skein::reasoning {

/// 200 s straight on at 20 m/s.
inline FlightPlan straight(const Vec3& from, double heading) {
  FlightElement e;
  e.duration = 200;
  e.airspeed = 20;
  e.heading = heading;
  e.p_N = from;
  return {e};
}

}  // namespace skein::reasoning
