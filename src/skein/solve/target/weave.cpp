// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/target/weave.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/target/orbit.h"
#include "skein/solve/target/orbit_entry.h"

namespace skein::solve {
namespace {

// Below this many radians the turns are so weak that the aircraft goes straight.
constexpr double kStraight = 1e-4;

constexpr double kLongest = 1200;  // that is looked ahead for a meeting [s]

struct Swing {
  double middle, half;  // headings go from middle - half to middle + half and back [rad]
};

Swing swing_at(const MovingTarget& target, const model::AirMotion& air, double time) {
  const Vec2 through_air = velocity_at(target, time) - air.wind;
  const double ratio = through_air.norm() / air.airspeed;
  return {ratio > 0 ? geo::bearing(through_air) : 0.0, weave_angle(std::min(1.0, ratio))};
}

// Over the target at a time, about to turn to the right (side 1) or left.
model::Pose begin_at(const MovingTarget& target, const model::AirMotion& air, double time,
                     int side) {
  const Swing s = swing_at(target, air, time);
  return {position_at(target, time), s.middle - side * s.half};
}

// The quicker path to a first turn; `side` is set to its direction.
template <class Connect>
FlightPlan quicker(const Connect& connect, int& side) {
  FlightPlan best;
  for (const int s : {1, -1}) {
    FlightPlan plan = connect(s);
    if (plan.empty()) continue;
    if (!best.empty() && model::end_time_of(plan) >= model::end_time_of(best)) continue;
    best = std::move(plan);
    side = s;
  }
  return best;
}

}  // namespace

double weave_angle(double ratio) {
  // sin(A) / A falls from 1 to 0 on [0, pi].
  double low = 0, high = geo::kPi;
  for (int i = 0; i < 60; ++i) {
    const double a = (low + high) / 2;
    (a == 0 || math::sin(a) > ratio * a ? low : high) = a;
  }
  return (low + high) / 2;
}

FlightPlan weave_along(const MovingTarget& target, const model::Pose& from,
                       const model::AirMotion& air, double start, double duration,
                       double down, double& entry) {
  int side = 1;
  FlightPlan plan = quicker(
      [&](int s) {
        const auto begin = [&](double t) { return begin_at(target, air, t, s); };
        FlightPlan approach = connection_to(begin, target, from, air, start, down);
        if (approach.empty())
          approach = meeting(begin, from, air, start, start + 1, start + kLongest, down);
        return approach;
      },
      side);
  model::Pose here = from;
  double now = start;
  const auto go_on_from_end = [&] {
    if (plan.empty()) return;
    const model::FlightMoment end = model::end_of(plan.back());
    here = {geo::horizontal(end.p_N), geo::wrap_pi(end.heading)};
    now = model::end_time_of(plan);
  };
  if (plan.empty()) {
    const model::Pose requested = begin_at(target, air, start, 1);
    const bool there = (requested.position - from.position).norm() < 1e-6 &&
                       std::abs(geo::wrap_pi(requested.course - from.course)) < 1e-9;
    if (!there) return {};
  }
  go_on_from_end();
  entry = now;
  while (now < entry + duration) {
    const Swing s = swing_at(target, air, now);
    const double change = next_change(target, now);
    const double turn = 2 * std::max(s.half, kStraight) * air.turn_radius / air.airspeed;
    if (now + turn > change + 1e-6) {
      // The next turn would not end over the target: meet it after the change.
      const FlightPlan approach = quicker(
          [&](int k) {
            return meeting([&](double t) { return begin_at(target, air, t, k); }, here,
                           air, now, change, change + kLongest, down);
          },
          side);
      if (approach.empty()) return plan;
      plan.insert(plan.end(), approach.begin(), approach.end());
      go_on_from_end();
      continue;
    }
    FlightElement e{now,
                    turn,
                    {here.position.x(), here.position.y(), down},
                    here.course,
                    air.airspeed,
                    s.half > kStraight ? side * air.airspeed / air.turn_radius : 0.0,
                    0,
                    air.wind};
    plan.push_back(e);
    go_on_from_end();
    side = -side;
  }
  return plan;
}

}  // namespace skein::solve
