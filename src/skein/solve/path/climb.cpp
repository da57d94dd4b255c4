// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/climb.h"

#include <cmath>

#include "skein/model/path/climb_profile.h"
#include "skein/model/path/flight_plan.h"

namespace skein::solve {

bool climb_along(FlightPlan& plan, double from_down, double to_down,
                 const FlightLimits& limits) {
  const double climb = from_down - to_down;
  const double rate = climb > 0 ? limits.climb_rate : limits.sink_rate;
  plan = model::climbing(plan, from_down,
                         model::quickest_climb(climb, rate, limits.climb_acceleration));
  const double end = plan.empty() ? from_down : model::end_of(plan.back()).p_N.z();
  return std::abs(end - to_down) < 1e-6;
}

}  // namespace skein::solve
