// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/flights/course_flight.h"

#include <algorithm>

#include "skein/geo/vec.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {

FlightPlan course_flight(const Vec3& p_N, const Vec3& v_N, double start, double duration,
                         double climb_for) {
  FlightPlan plan;
  FlightElement e;
  e.start = start;
  e.p_N = p_N;
  e.heading = geo::bearing(v_N.head<2>());
  e.airspeed = v_N.head<2>().norm();
  const double climbing = std::clamp(climb_for, 0.0, duration);
  if (climbing > 0 && v_N.z() != 0) {
    e.duration = climbing;
    e.climb_rate = -v_N.z();
    plan.push_back(e);
    e.start += climbing;
    e.p_N = model::end_of(plan.back()).p_N;
    e.climb_rate = 0;
  }
  e.duration = start + duration - e.start;
  if (e.duration > 0) plan.push_back(e);
  return plan;
}

}  // namespace skein::reasoning
