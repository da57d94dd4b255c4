// SPDX-License-Identifier: Apache-2.0
#include "skein/model/connection/point_connection.h"

#include <cmath>

#include "skein/base/check.h"
#include "skein/model/connection/plan_builder.h"
#include "skein/model/connection/words_point.h"
#include "skein/model/path/point_path.h"

namespace skein::model {

PointConnection connect_to_point(const Pose& from, const Vec2& point,
                                 const AirMotion& air) {
  PointConnection best;
  best.time = words::kNever;
  const bool usable =
      from.position.allFinite() && std::isfinite(from.course) && point.allFinite() &&
      air.wind.allFinite() && std::isfinite(air.airspeed) &&
      std::isfinite(air.turn_radius) && air.airspeed > 0 && air.turn_radius > 0 &&
      (point - from.position).norm() <= words::kFarthest * air.turn_radius;
  if (!usable) return best;
  if (words::is_calm(air.wind, air.airspeed)) {
    const PointPath path = shortest_to_point(from, point, air.turn_radius);
    return {ConnectionStatus::kFound,
            path.right,
            path.straight,
            {path.first, path.second},
            (path.first + path.second) * air.turn_radius / air.airspeed};
  }
  const Vec2 along = geo::unit(from.course);
  const auto seen = [&](const Vec2& v) {
    return Vec2(along.dot(v), geo::cross(along, v));
  };
  words::PointProblem right;
  right.point = seen(point - from.position) / air.turn_radius;
  right.wind = seen(air.wind) / air.airspeed;
  right.wind2 = right.wind.squaredNorm();
  if (right.wind2 >= 1) {
    best.status = ConnectionStatus::kWindTooStrong;
    return best;
  }
  best.status = ConnectionStatus::kFound;
  if (right.point.isZero(0)) {
    best.time = 0;
    return best;
  }
  const words::PointProblem left = right.mirrored();
  double time = words::kNever;
  const auto take = [&](bool to_right, bool straight, const words::Meeting& m) {
    if (!(m.time < time)) return;
    time = m.time;
    best.right = to_right;
    best.straight = straight;
    best.parts = {m.parts[0], m.parts[1]};
  };
  const bool on_right = right.point.y() >= 0;
  const words::PointProblem &near = on_right ? right : left,
                            &far = on_right ? left : right;
  take(on_right, true, words::turn_straight(near, time));
  if (!words::stays_outside(near, time)) {
    take(!on_right, true, words::turn_straight(far, time));
    take(on_right, false, words::turn_turn(near, time));
    take(!on_right, false, words::turn_turn(far, time));
  }
  SKEIN_CHECK(time < words::kNever, from.course, air.airspeed);
  best.time = time * air.turn_radius / air.airspeed;
  return best;
}

FlightPlan to_flight_plan(const PointConnection& connection, const Pose& from,
                          const AirMotion& air, double start, double down) {
  if (connection.status != ConnectionStatus::kFound) return {};
  const double side = connection.right ? 1 : -1;
  PlanBuilder plan(from, air, start, down);
  plan.fly(connection.parts[0], side);
  plan.fly(connection.parts[1], connection.straight ? 0 : -side);
  return plan.take();
}

}  // namespace skein::model
