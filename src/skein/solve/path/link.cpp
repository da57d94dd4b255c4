// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/link.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/model/path/climb_profile.h"
#include "skein/model/path/flight_plan.h"

namespace skein::solve {
namespace {

constexpr double kMaxTurns = 10'000;
// A wait that is not enough grows by this part of a full turn at least, then by twice as
// much.
constexpr double kMinWait = 1.0 / 4096;

}  // namespace

double climb_time(double climb, const FlightLimits& limits) {
  return model::climb_time(std::abs(climb),
                           climb > 0 ? limits.climb_rate : limits.sink_rate,
                           limits.climb_acceleration);
}

model::AirMotion air_of(const PathQuery& query) {
  return {query.limits.airspeed, query.limits.turn_radius, query.wind};
}

double full_turn(const PathQuery& query) {
  return 2 * geo::kPi * query.limits.turn_radius / query.limits.airspeed;
}

Link link(const FlightState& from, const FlightState& to, const PathQuery& query,
          double wait) {
  const model::AirMotion air = air_of(query);
  Link out;
  out.climb = from.p_N.z() - to.p_N.z();
  const double needed = climb_time(out.climb, query.limits);
  const model::Pose begin{geo::horizontal(from.p_N), from.heading};
  out.wait = wait;
  const auto connect_after_wait = [&] {
    const Vec2 goal = geo::horizontal(to.p_N) - query.wind * out.wait;
    out.connection = model::connect(begin, {goal, to.heading}, air);
    out.duration = out.wait + out.connection.time;
  };
  connect_after_wait();
  const double turn = full_turn(query);
  // Without wind the wait is known at once; in wind turns carry the aircraft away from
  // the goal or towards it, and what is left changes.
  double min = kMinWait * turn;
  while (out.duration < needed * (1 - 1e-12)) {
    out.wait = std::max(turn, out.wait + std::max(needed - out.duration, min));
    min *= 2;
    connect_after_wait();
    if (out.wait > kMaxTurns * turn) out.duration = math::kInfinity;
  }
  return out;
}

FlightElement loiter(const FlightState& from, double start, double time,
                     const PathQuery& query) {
  const int turns = static_cast<int>(std::floor(time / full_turn(query) + 1e-9));
  SKEIN_CHECK(turns >= 1, time);
  return {start,
          time,
          from.p_N,
          from.heading,
          query.limits.airspeed,
          2 * geo::kPi * turns / time,
          0,
          query.wind};
}

FlightPlan to_flight_plan(const Link& link, const FlightState& from, double start,
                          const PathQuery& query) {
  FlightPlan plan;
  FlightState begin = from;
  if (link.wait > 0) {
    plan.push_back(loiter(from, start, link.wait, query));
    begin = state_after(plan);
    begin.heading = from.heading;
    start += plan.back().duration;
  }
  const model::Pose pose{geo::horizontal(begin.p_N), begin.heading};
  const FlightPlan rest =
      model::to_flight_plan(link.connection, pose, air_of(query), start, begin.p_N.z());
  plan.insert(plan.end(), rest.begin(), rest.end());
  if (link.climb == 0) return plan;
  return model::climbing(
      plan, from.p_N.z(),
      model::even_climb(link.climb, link.duration, query.limits.climb_acceleration));
}

bool is_exact(const Link& link) {
  return !link.connection.irregular && link.wait == 0;
}

double min_time(const Link& link, const FlightState& from, const FlightState& to,
                const PathQuery& query) {
  const double climb = climb_time(link.climb, query.limits);
  const bool exact = is_exact(link);
  if (exact) return std::max(link.connection.time, climb);
  const double fastest = query.limits.airspeed + query.wind.norm();
  return std::max(geo::horizontal(to.p_N - from.p_N).norm() / fastest, climb);
}

FlightState state_after(const FlightElement& element) {
  const model::FlightMoment end = model::end_of(element);
  return {end.p_N, end.heading};
}

FlightState state_after(const FlightPlan& plan) {
  SKEIN_CHECK(!plan.empty());
  return state_after(plan.back());
}

}  // namespace skein::solve
