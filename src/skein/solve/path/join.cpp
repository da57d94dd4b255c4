// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/join.h"

#include <cmath>

#include "skein/base/check.h"
#include "skein/model/connection/airplane.h"
#include "skein/model/path/flight_plan.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::solve {

model::AirMotion motion_of(const FlightLimits& limits, const Vec2& wind) {
  return {limits.airspeed, limits.turn_radius, wind};
}

model::Pose pose_of(const FlightState& state) {
  return {geo::horizontal(state.p_N), state.heading};
}

FlightPlan join(const FlightState& from, const FlightState& to,
                const FlightLimits& limits, const Vec2& wind, double start) {
  const model::AirMotion air = motion_of(limits, wind);
  // Rounding of altitudes is no climb, and level flight needs no climb rate.
  if (std::abs(from.p_N.z() - to.p_N.z()) < 1e-9) {
    const model::Pose begin = pose_of(from);
    return model::to_flight_plan(model::connect(begin, pose_of(to), air), begin, air,
                                 start, from.p_N.z());
  }
  const model::ClimbLimits climb{limits.climb_rate, limits.sink_rate,
                                 limits.climb_acceleration};
  return model::starting_at(model::connect(from, to, air, climb).plan, start);
}

FlightElement straight(const Vec2& from, const Vec2& to, double down,
                       const model::AirMotion& air, double start) {
  const Vec2 leg = to - from;
  const auto heading =
      model::heading_for_course(geo::bearing(leg), air.airspeed, air.wind);
  SKEIN_CHECK(heading.has_value(), air.airspeed, air.wind.norm());
  const double speed = (air.airspeed * geo::unit(*heading) + air.wind).norm();
  return {start,
          leg.norm() / speed,
          {from.x(), from.y(), down},
          *heading,
          air.airspeed,
          0,
          0,
          air.wind};
}

FlightState end_state(const FlightPlan& plan) {
  const model::FlightMoment end = model::end_of(plan.back());
  return {end.p_N, geo::wrap_pi(end.heading)};
}

}  // namespace skein::solve
