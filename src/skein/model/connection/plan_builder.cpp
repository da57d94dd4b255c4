// SPDX-License-Identifier: Apache-2.0
#include "skein/model/connection/plan_builder.h"

#include "skein/model/path/flight_plan.h"

namespace skein::model {

PlanBuilder::PlanBuilder(const Pose& from, const AirMotion& air, double start,
                         double down)
    : air_(air) {
  next_.start = start;
  next_.p_N = {from.position.x(), from.position.y(), down};
  next_.heading = from.course;
  next_.airspeed = air.airspeed;
  next_.wind = air.wind;
}

void PlanBuilder::fly(double length, double side) {
  if (!(length > 0)) return;
  next_.duration = length * air_.turn_radius / air_.airspeed;
  next_.turn_rate = side * air_.airspeed / air_.turn_radius;
  plan_.push_back(next_);
  const FlightMoment end = end_of(next_);
  next_.start += next_.duration;
  next_.p_N = end.p_N;
  next_.heading = end.heading;
}

}  // namespace skein::model
