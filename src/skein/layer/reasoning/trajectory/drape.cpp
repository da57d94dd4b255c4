// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/drape.h"

#include <algorithm>

#include "skein/layer/reasoning/trajectory/altitude.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr double kStraightStep = 4;  // between looks at the ground on straights [s]
constexpr double kReserve = 0.75;    // of the rates: the curve may be steeper in between

}  // namespace

Plan drape(const FlightPlan& plan, const Terrain& ground, double height,
           const FlightLimits& limits, double down) {
  Plan points = model::sample(plan, {.straight = kStraightStep});
  double altitude = -down;
  Time before = points.empty() ? Time() : points.front().time;
  for (PlanPoint& point : points) {
    const double dt = (point.time - before).seconds();
    const double setpoint =
        altitude_over(ground, geo::horizontal(point.p_N), geo::horizontal(point.v_N),
                      height, limits.climb_rate);
    altitude = std::clamp(setpoint, altitude - kReserve * limits.sink_rate * dt,
                          altitude + kReserve * limits.climb_rate * dt);
    before = point.time;
    point.p_N.z() = -altitude;
  }
  // The curve through the points climbs as from one neighbour to the other.
  for (std::size_t k = 0; k < points.size(); ++k) {
    const PlanPoint& a = points[k == 0 ? 0 : k - 1];
    const PlanPoint& b = points[std::min(k + 1, points.size() - 1)];
    const double dt = (b.time - a.time).seconds();
    points[k].v_N.z() = dt > 0 ? (b.p_N.z() - a.p_N.z()) / dt : 0;
  }
  return points;
}

}  // namespace skein::reasoning
