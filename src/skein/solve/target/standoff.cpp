// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/target/standoff.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/model/path/flight_plan.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::solve {
namespace {

constexpr double kInstant = 1e-7;  // rounding of the run's clock [s]

struct SpeedRange {
  double min, max;
};

SpeedRange range_of(const FlightLimits& limits, double felt, double wind) {
  return {std::max({limits.slowest, kWindReserve * felt, kWindReserve * wind, 1e-3}),
          limits.fastest};
}

// Heading that leads along the circle from a place near it.
double heading_at(const Standoff& s, const Vec2& position, double time) {
  const Vec2 from_target = position - position_at(s.target, time);
  const double off = from_target.norm() - s.radius;
  const double gentle = std::max(s.radius / 2, 1.5 * s.speed.turn_radius);
  const double course =
      geo::bearing(from_target) + s.side * (geo::kPi / 2 + math::atan(off / gentle));
  const auto heading = model::heading_for_course(course, s.speed.airspeed,
                                                 s.wind - velocity_at(s.target, time));
  SKEIN_CHECK(heading.has_value(), course, s.speed.airspeed);
  return *heading;
}

// The turn rate with which an element ends with the heading that the circle wants there.
double turn_rate_of(const Standoff& s, FlightElement e) {
  // Just before the end: a change of the target's velocity counts after it.
  const double end = std::max(e.start, e.start + e.duration - 1e-9);
  double rate = 0;
  for (int i = 0; i < 20; ++i) {
    const double requested = heading_at(s, geo::horizontal(model::end_of(e).p_N), end);
    const double next = geo::wrap_pi(requested - e.heading) / e.duration;
    const bool done = std::abs(next - rate) * e.duration < 1e-13;
    e.turn_rate = rate = next;
    if (done) break;
  }
  const double max = s.speed.airspeed / s.speed.turn_radius;
  return std::clamp(rate, -max, max);
}

}  // namespace

double turn_radius_at(double airspeed, const FlightLimits& limits) {
  const double ratio = airspeed / limits.airspeed;
  return limits.turn_radius * ratio * ratio;
}

double min_standoff(double airspeed, const FlightLimits& limits, double felt) {
  if (felt >= airspeed) return std::numeric_limits<double>::infinity();
  return model::ground_turn_radius(turn_radius_at(airspeed, limits), airspeed, felt);
}

std::optional<FlyingSpeed> speed_for_circle(double radius, const FlightLimits& limits,
                                            double felt, double wind) {
  const SpeedRange range = range_of(limits, felt, wind);
  // min_standoff solved for the airspeed.
  const double max = std::min(
      range.max, std::sqrt(radius / limits.turn_radius) * limits.airspeed - felt);
  if (max < range.min) return std::nullopt;
  const double airspeed = std::clamp(limits.airspeed, range.min, max);
  return FlyingSpeed{airspeed, turn_radius_at(airspeed, limits)};
}

double min_standoff(const FlightLimits& limits, double felt, double wind) {
  const SpeedRange range = range_of(limits, felt, wind);
  if (range.min > range.max) return std::numeric_limits<double>::infinity();
  return min_standoff(range.min, limits, felt);
}

model::Pose pose_on(const Standoff& s, double bearing, double time) {
  const Vec2 p = position_at(s.target, time) + s.radius * geo::unit(bearing);
  return {p, heading_at(s, p, time)};
}

FlightPlan along_circle(const Standoff& s, const model::Pose& from, double start,
                        double duration, double step, double down) {
  FlightPlan plan;
  FlightElement e;
  e.start = start;
  e.p_N = {from.position.x(), from.position.y(), down};
  e.heading = from.course;
  e.airspeed = s.speed.airspeed;
  e.wind = s.wind;
  const double end = start + duration;
  while (end - e.start > kInstant) {
    const double until = std::min(next_change(s.target, e.start + kInstant), end);
    const double steps = std::ceil((until - e.start) / step - 1e-9);
    e.duration = (until - e.start) / std::max(1.0, steps);
    e.turn_rate = turn_rate_of(s, e);
    plan.push_back(e);
    const model::FlightMoment there = model::end_of(e);
    e.start += e.duration;
    e.p_N = there.p_N;
    e.heading = geo::wrap_pi(there.heading);
  }
  return plan;
}

double largest_error(const Standoff& s, const FlightPlan& plan) {
  double largest = 0;
  for (const FlightElement& e : plan)
    for (int k = 1; k <= 8; ++k) {
      const double t = e.duration * k / 8;
      const Vec2 p = geo::horizontal(model::position(e, t));
      largest = std::max(
          largest, std::abs((p - position_at(s.target, e.start + t)).norm() - s.radius));
    }
  return largest;
}

}  // namespace skein::solve
