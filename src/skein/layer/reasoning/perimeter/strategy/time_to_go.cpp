// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/strategy/time_to_go.h"

#include <cmath>

#include "skein/model/connection/point_connection.h"

namespace skein::perimeter {

double time_to_go(const AircraftStatus& aircraft, const Vec2& place) {
  const NavEstimate& nav = aircraft.nav;
  return model::connect_to_point(
             {geo::horizontal(nav.p_N), nav.heading}, place,
             {aircraft.limits.airspeed, aircraft.limits.turn_radius, nav.wind_N})
      .time;
}

BoundaryPoint carried_on(const BoundaryPoint& point, double time) {
  BoundaryPoint later = point;
  later.position += time * point.rate * point.normal;
  later.sigma += time * point.sigma_growth;
  return later;
}

Meeting meet(const AircraftStatus& aircraft, const BoundaryPoint& point) {
  Meeting meeting{point, time_to_go(aircraft, point.position)};
  for (int k = 0; k < 2 && std::isfinite(meeting.t_go); ++k) {
    meeting.point = carried_on(point, meeting.t_go);
    meeting.t_go = time_to_go(aircraft, meeting.point.position);
  }
  return meeting;
}

}  // namespace skein::perimeter
