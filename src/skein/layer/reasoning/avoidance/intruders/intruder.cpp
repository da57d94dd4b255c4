// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/intruders/intruder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/math.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr double kLookAhead = 60;           // [s]
constexpr double kStep = 0.5;               // [s]
constexpr double kForesight = 10;           // for which room is kept [s]
constexpr double kAcross = 1.5, kUp = 0.7;  // accelerations [m/s^2 / sqrt(Hz)]
constexpr double kMargin = 5;               // before and after an intersection [s]
constexpr int kCorners = 24;                // of a static room

double sd_after(double place, double speed, double acceleration, double t) {
  t = std::min(t, kForesight);
  return std::sqrt(place * place + speed * speed * t * t +
                   acceleration * acceleration * t * t * t / 3);
}

}  // namespace

double horizontal_sd_after(const AvoidedIntruder& intruder, double t) {
  return sd_after(intruder.horizontal_sd, intruder.horizontal_speed_sd, kAcross, t);
}

double vertical_sd_after(const AvoidedIntruder& intruder, double t) {
  return sd_after(intruder.vertical_sd, intruder.vertical_speed_sd, kUp, t);
}

std::optional<PredictedIntersection> predicted_intersection(
    const FlightPlan& plan, const AvoidedIntruder& intruder, double now, double sigmas) {
  PredictedIntersection found;
  const double until = std::min(now + kLookAhead, model::end_time_of(plan));
  bool inside = false;
  for (double time = now; time <= until; time += kStep) {
    const double t = std::max(0.0, time - intruder.time);
    const Vec3 apart = intruder.p_N + t * intruder.v_N - model::moment_at(plan, time).p_N;
    const double h_sd = horizontal_sd_after(intruder, time - now);
    const double z_sd = vertical_sd_after(intruder, time - now);
    const Separation kept{intruder.kept.horizontal + sigmas * h_sd,
                          intruder.kept.vertical + sigmas * z_sd};
    const double ratio = kept.ratio(apart.head<2>().norm(), std::abs(apart.z()));
    if (ratio >= 1) continue;
    if (!inside) found.begin = time;
    inside = true;
    found.end = time;
    if (ratio >= found.ratio) continue;
    found.ratio = ratio;
    found.closest_time = time;
    found.kept = kept;
  }
  if (!inside) return std::nullopt;
  return found;
}

FlightPlan flight_of(const AvoidedIntruder& intruder, double from, double until) {
  FlightElement straight;
  straight.start = from;
  straight.duration = until - from;
  straight.p_N = intruder.p_N + (from - intruder.time) * intruder.v_N;
  straight.heading = geo::bearing(intruder.v_N.head<2>());
  straight.airspeed = intruder.v_N.head<2>().norm();
  straight.climb_rate = -intruder.v_N.z();
  return {straight};
}

MovingObstacle room_of(const AvoidedIntruder& intruder,
                       const PredictedIntersection& encounter) {
  MovingObstacle room;
  room.time = intruder.time;
  room.p_N = intruder.p_N;
  room.v_N = intruder.v_N;
  room.radius = encounter.kept.horizontal;
  room.height = encounter.kept.vertical;
  room.from = encounter.begin - kMargin;
  room.until = encounter.end + kMargin;
  return room;
}

Zone static_room_of(const AvoidedIntruder& intruder,
                    const PredictedIntersection& encounter) {
  const double half = (encounter.end - encounter.begin) / 2;
  const Vec3 middle =
      intruder.p_N + (encounter.begin + half - intruder.time) * intruder.v_N;
  const Vec2 v = intruder.v_N.head<2>();
  const Vec2 along = v.norm() > 0 ? Vec2(v.normalized()) : Vec2(1, 0);
  const Vec2 across = geo::turned_right(along);
  // The corners are so far out that the sides touch the ellipse.
  const double out = 1 / math::cos(geo::kPi / kCorners);
  const double b = out * encounter.kept.horizontal;
  const double a = b + out * v.norm() * half;
  geo::Ring ring;
  for (int k = 0; k < kCorners; ++k) {
    const Vec2 corner = geo::unit(2 * geo::kPi * k / kCorners);
    ring.push_back(middle.head<2>() + a * corner.x() * along + b * corner.y() * across);
  }
  Zone room;
  room.area = made_positive(std::move(ring));
  const double sweeps = std::abs(intruder.v_N.z()) * half;
  room.floor_msl = -middle.z() - encounter.kept.vertical - sweeps;
  room.ceiling_msl = -middle.z() + encounter.kept.vertical + sweeps;
  room.from = encounter.begin - kMargin;
  room.until = encounter.end + kMargin;
  return room;
}

}  // namespace skein::reasoning
