#include "model/connection/point_connection.h"

#include <cmath>

#include "base/check.h"
#include "model/connection/words_point.h"
#include "model/path/flight_plan.h"
#include "model/path/point_path.h"

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

FlightPlan to_flight_plan(const PointConnection& c, const Pose& from,
                          const AirMotion& air, double start, double down) {
  FlightPlan plan;
  if (c.status != ConnectionStatus::kFound) return plan;
  const double rate = air.airspeed / air.turn_radius, side = c.right ? 1 : -1;
  FlightElement e;
  e.start = start;
  e.p_N = {from.position.x(), from.position.y(), down};
  e.heading = from.course;
  e.airspeed = air.airspeed;
  e.wind = air.wind;
  for (const auto& [part, turn] :
       {std::pair{c.parts[0], side}, std::pair{c.parts[1], c.straight ? 0 : -side}}) {
    if (part <= 0) continue;
    e.duration = part / rate;
    e.turn_rate = turn * rate;
    plan.push_back(e);
    const FlightMoment end = end_of(e);
    e.start += e.duration;
    e.p_N = end.p_N;
    e.heading = end.heading;
  }
  return plan;
}

}  // namespace skein::model
