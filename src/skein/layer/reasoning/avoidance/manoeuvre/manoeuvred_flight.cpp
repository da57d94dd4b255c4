// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/manoeuvre/manoeuvred_flight.h"

#include <algorithm>
#include <cmath>

#include "skein/model/path/climb_profile.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/link.h"
#include "skein/solve/path/repair.h"

namespace skein::reasoning {
namespace {

constexpr double kLevelBefore = 4;  // the conflict: an aircraft lags behind a climb [s]
constexpr double kLevelAfter = 2;   // the conflict [s]
constexpr double kLevel = 1e-3;     // climb rates below it [m/s]
constexpr double kSpeedAfter = 2;   // the conflict [s]

// Flights to the end of the conflict's plan.
class Maker {
 public:
  Maker(const ConflictOfFlight& conflict, const Vec2& wind)
      : conflict_(conflict), end_(model::end_time_of(conflict.plan)) {
    query_.limits = conflict.limits;
    query_.wind = wind;
    goal_ = solve::state_after(conflict.plan);
  }

  std::optional<FlightPlan> direct() const {
    FlightPlan flight;
    if (!go(flight, moment(conflict_.begin), conflict_.begin, goal_)) return std::nullopt;
    return flight;
  }
  std::optional<FlightPlan> aside(double right, double lead) const;
  std::optional<FlightPlan> up(double height, double lead) const;
  std::optional<FlightPlan> speed(double factor) const;
  std::optional<FlightPlan> turned(double change, double until) const;
  std::optional<FlightPlan> turned_on(const PresentMotion& present, double change,
                                      double duration) const;

 private:
  model::FlightMoment moment(double time) const {
    return model::moment_at(conflict_.plan, time);
  }
  FlightState at(double time) const {
    const model::FlightMoment m = moment(time);
    return {m.p_N, m.heading};
  }
  FlightPlan kept_until(double time) const {
    return solve::part_of(conflict_.plan, conflict_.begin, time);
  }
  bool go(FlightPlan& flight, model::FlightMoment from, double start,
          const FlightState& to) const;
  bool go_on(FlightPlan& flight, const FlightState& to) const {
    return go(flight, model::end_of(flight.back()), model::end_time_of(flight), to);
  }

  const ConflictOfFlight& conflict_;
  double end_;
  PathQuery query_;
  FlightState goal_;
};

// By a link, whose climbs begin level: a climb is ended before, straight on.
bool Maker::go(FlightPlan& flight, model::FlightMoment from, double start,
               const FlightState& to) const {
  const double climb = -from.v_N.z(), acceleration = query_.limits.climb_acceleration;
  if (std::abs(climb) > kLevel && acceleration > 0) {
    FlightElement level_off;
    level_off.start = start;
    level_off.duration = std::abs(climb) / acceleration;
    level_off.p_N = from.p_N;
    level_off.heading = from.heading;
    level_off.airspeed = query_.limits.airspeed;
    level_off.wind = query_.wind;
    level_off.climb_rate = climb;
    level_off.climb_acceleration = -std::copysign(acceleration, climb);
    flight.push_back(level_off);
    start += level_off.duration;
    from = model::end_of(level_off);
  }
  const FlightState state{from.p_N, from.heading};
  const solve::Link link = solve::link(state, to, query_);
  if (!std::isfinite(link.duration)) return false;
  const FlightPlan more = solve::to_flight_plan(link, state, start, query_);
  flight.insert(flight.end(), more.begin(), more.end());
  return true;
}

std::optional<FlightPlan> Maker::aside(double right, double lead) const {
  const double left_at = std::max(conflict_.begin, conflict_.meets - lead);
  const double beside = std::min(conflict_.closest_time, end_);
  if (left_at >= beside) return std::nullopt;
  FlightState via = at(beside);
  via.p_N.head<2>() += right * geo::turned_right(geo::unit(via.heading));
  FlightPlan flight = kept_until(left_at);
  if (!go(flight, moment(left_at), left_at, via) || !go_on(flight, goal_))
    return std::nullopt;
  return flight;
}

// The quickest change of altitude of an aircraft that climbs already, or sinks.
model::ClimbProfile climb_from(double now, double height, double rate,
                               double acceleration) {
  if (std::abs(now) < kLevel || acceleration <= 0)
    return model::quickest_climb(height, rate, acceleration);
  const double sign = height > 0 ? 1 : -1, along = sign * now;
  const double begins = (rate * rate - along * along) / (2 * acceleration);
  const double ends = rate * rate / (2 * acceleration);
  const double even = (std::abs(height) - begins - ends) / rate;
  if (along > 0 && along <= rate && even >= 0)
    return {{(rate - along) / acceleration, now, sign * acceleration},
            {even, sign * rate, 0},
            {rate / acceleration, sign * rate, -sign * acceleration}};
  // Level first.
  model::ClimbProfile profile = {
      {std::abs(now) / acceleration, now, -std::copysign(acceleration, now)}};
  const double rest = height - now * std::abs(now) / (2 * acceleration);
  const auto more = model::quickest_climb(rest, rate, acceleration);
  profile.insert(profile.end(), more.begin(), more.end());
  return profile;
}

std::optional<FlightPlan> Maker::up(double height, double lead) const {
  const FlightLimits& limits = conflict_.limits;
  const double rate = height > 0 ? limits.climb_rate : limits.sink_rate;
  if (!(rate > 0)) return std::nullopt;
  const double climb =
      model::climb_time(std::abs(height), rate, limits.climb_acceleration);
  const double left_at =
      std::max(conflict_.begin, conflict_.meets - std::max(kLevelBefore + climb, lead));
  const double level_until = std::min(conflict_.apart + kLevelAfter, end_);
  if (left_at + climb > level_until) return std::nullopt;
  FlightPlan flight = kept_until(left_at);
  const FlightPlan beside = solve::part_of(conflict_.plan, left_at, level_until);
  if (beside.empty()) return std::nullopt;
  const FlightPlan higher = model::climbing(
      beside, beside.front().p_N.z(),
      climb_from(-moment(left_at).v_N.z(), height, rate, limits.climb_acceleration));
  flight.insert(flight.end(), higher.begin(), higher.end());
  if (!go_on(flight, goal_)) return std::nullopt;
  return flight;
}

std::optional<FlightPlan> Maker::speed(double factor) const {
  const double until = std::min(conflict_.apart + kSpeedAfter, end_);
  if (until <= conflict_.begin) return std::nullopt;
  Maker other = *this;
  other.query_.limits.airspeed *= factor;
  // Speed squared over gravity and the tangent of the bank.
  other.query_.limits.turn_radius *= factor * factor;
  if (query_.wind.norm() >= other.query_.limits.airspeed) return std::nullopt;
  FlightPlan flight;
  if (!other.go(flight, moment(conflict_.begin), conflict_.begin, at(until)))
    return std::nullopt;
  if (until < end_ && !go_on(flight, goal_)) return std::nullopt;
  return flight;
}

std::optional<FlightPlan> Maker::turned(double change, double until) const {
  const model::FlightMoment from = moment(conflict_.begin);
  const double time = until - conflict_.begin;
  if (time <= 0) return std::nullopt;
  FlightState via = at(std::min(until, end_));
  via.heading = geo::wrap_pi(from.heading + change);
  via.p_N.head<2>() =
      from.p_N.head<2>() +
      time * (conflict_.limits.airspeed * geo::unit(via.heading) + query_.wind);
  FlightPlan flight;
  if (!go(flight, from, conflict_.begin, via) || !go_on(flight, goal_))
    return std::nullopt;
  return flight;
}

std::optional<FlightPlan> Maker::turned_on(const PresentMotion& present, double change,
                                           double duration) const {
  FlightElement e;
  e.start = conflict_.begin;
  e.p_N = present.p_N;
  e.heading = geo::bearing(present.v_N.head<2>() - query_.wind);
  e.airspeed = query_.limits.airspeed;
  e.wind = query_.wind;
  FlightPlan flight;
  double turns_for = 0;
  if (change != 0 && query_.limits.turn_radius > 0) {
    e.turn_rate = std::copysign(e.airspeed / query_.limits.turn_radius, change);
    turns_for = e.duration = std::min(duration, change / e.turn_rate);
    flight.push_back(e);
    e.start += e.duration;
    const model::FlightMoment turned = model::end_of(e);
    e.p_N = turned.p_N;
    e.heading = turned.heading;
    e.turn_rate = 0;
  }
  e.duration = duration - turns_for;
  if (e.duration > 0) flight.push_back(e);
  if (flight.empty() || !go_on(flight, goal_)) return std::nullopt;
  return flight;
}

Maker maker_of(const ConflictOfFlight& conflict) {
  const FlightPlan rest =
      solve::part_of(conflict.plan, conflict.begin, model::end_time_of(conflict.plan));
  return {conflict, rest.front().wind};
}

std::optional<FlightPlan> made(const Manoeuvre& manoeuvre,
                               const ConflictOfFlight& conflict) {
  const Maker maker = maker_of(conflict);
  switch (manoeuvre.kind) {
    case ManoeuvreKind::kRight:
      return maker.aside(manoeuvre.amount, manoeuvre.lead);
    case ManoeuvreKind::kLeft:
      return maker.aside(-manoeuvre.amount, manoeuvre.lead);
    case ManoeuvreKind::kUp:
      return maker.up(manoeuvre.amount, manoeuvre.lead);
    case ManoeuvreKind::kDown:
      return maker.up(-manoeuvre.amount, manoeuvre.lead);
    case ManoeuvreKind::kSpeed:
      return maker.speed(manoeuvre.amount);
    default:
      return maker.direct();
  }
}

bool begins_in_plan(const ConflictOfFlight& conflict) {
  return !conflict.plan.empty() && conflict.begin < model::end_time_of(conflict.plan) &&
         conflict.begin >= model::start_of(conflict.plan);
}

// No steeper than the aircraft climbs and sinks: a climb on top of another may be.
bool within(const FlightPlan& flight, const FlightLimits& limits) {
  constexpr double kRounding = 1.001;
  for (const FlightElement& e : flight)
    for (const double rate :
         {e.climb_rate, e.climb_rate + e.climb_acceleration * e.duration})
      if (rate > kRounding * limits.climb_rate || -rate > kRounding * limits.sink_rate)
        return false;
  return true;
}

}  // namespace

std::optional<FlightPlan> manoeuvred(const Manoeuvre& manoeuvre,
                                     const ConflictOfFlight& conflict) {
  if (!begins_in_plan(conflict)) return std::nullopt;
  if (manoeuvre.kind == ManoeuvreKind::kGoOn)
    return solve::part_of(conflict.plan, conflict.begin,
                          model::end_time_of(conflict.plan));
  const auto flight = made(manoeuvre, conflict);
  return flight && within(*flight, conflict.limits) ? flight : std::nullopt;
}

std::optional<FlightPlan> turned_on_flight(const ConflictOfFlight& conflict,
                                           const PresentMotion& present, double change,
                                           double duration) {
  if (!begins_in_plan(conflict)) return std::nullopt;
  return maker_of(conflict).turned_on(present, change, duration);
}

std::optional<FlightPlan> turned_flight(const ConflictOfFlight& conflict, double change,
                                        double until) {
  if (!begins_in_plan(conflict)) return std::nullopt;
  const auto flight = maker_of(conflict).turned(change, until);
  return flight && within(*flight, conflict.limits) ? flight : std::nullopt;
}

}  // namespace skein::reasoning
