// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/strategy/time_to_go.h"

#include <algorithm>
#include <cmath>

#include "skein/model/connection/point_connection.h"

namespace skein::perimeter {
namespace {

// More than any flight to a point is longer than the straight line: a turn leads out of
// the turning circle that the point may be in, another one towards it.
constexpr double kMaxDetour = 15;  // turn radii
constexpr double kReserve = 2;     // on the time that a flight takes at most

}  // namespace

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

double min_time_to_meet(const AircraftStatus& aircraft, const BoundaryPoint& point) {
  const NavEstimate& nav = aircraft.nav;
  const double wind = nav.wind_N.norm(), slowest = aircraft.limits.airspeed - wind;
  if (!(slowest > 0)) return 0;
  const double away = (point.position - geo::horizontal(nav.p_N)).norm();
  const double rate = std::abs(point.rate);
  const auto max_time = [&](double distance) {
    return kReserve * (distance + kMaxDetour * aircraft.limits.turn_radius) / slowest;
  };
  // The point moves during the flight to where the flight before would have met it.
  const double moved = rate * max_time(away + rate * max_time(away));
  return std::max(0.0, away - moved) / (aircraft.limits.airspeed + wind);
}

}  // namespace skein::perimeter
