#include "skein/layer/reasoning/avoidance/manoeuvre/manoeuvred_flight.h"

#include <algorithm>
#include <cmath>

#include "skein/layer/reasoning/planning/search/link.h"
#include "skein/layer/reasoning/planning/search/repair.h"
#include "skein/model/path/climb_profile.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr double kLevelBefore = 4;  // the conflict: an aircraft lags behind a climb [s]
constexpr double kLevelAfter = 2;   // the conflict [s]
constexpr double kSpeedAfter = 2;   // the conflict [s]

// Flights to the end of the conflict's plan.
class Maker {
 public:
  Maker(const ConflictOfFlight& conflict, const Vec2& wind)
      : conflict_(conflict), end_(model::end_time_of(conflict.plan)) {
    query_.limits = conflict.limits;
    query_.wind = wind;
    goal_ = planning::state_after(conflict.plan);
  }

  std::optional<FlightPlan> direct() const {
    FlightPlan flight;
    if (!go(flight, at(conflict_.begin), conflict_.begin, goal_)) return std::nullopt;
    return flight;
  }
  std::optional<FlightPlan> aside(double right, double lead) const;
  std::optional<FlightPlan> up(double height) const;
  std::optional<FlightPlan> speed(double factor) const;

 private:
  FlightState at(double time) const {
    const model::FlightMoment m = model::moment_at(conflict_.plan, time);
    return {m.p_N, m.heading};
  }
  FlightPlan kept_until(double time) const {
    return planning::part_of(conflict_.plan, conflict_.begin, time);
  }
  bool go(FlightPlan& flight, const FlightState& from, double start,
          const FlightState& to) const;
  bool go_on(FlightPlan& flight, const FlightState& to) const {
    return go(flight, planning::state_after(flight), model::end_time_of(flight), to);
  }

  const ConflictOfFlight& conflict_;
  double end_;
  PathQuery query_;
  FlightState goal_;
};

bool Maker::go(FlightPlan& flight, const FlightState& from, double start,
               const FlightState& to) const {
  const planning::Link link = planning::link(from, to, query_);
  if (!std::isfinite(link.duration)) return false;
  const FlightPlan more = planning::to_flight_plan(link, from, start, query_);
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
  if (!go(flight, at(left_at), left_at, via) || !go_on(flight, goal_))
    return std::nullopt;
  return flight;
}

std::optional<FlightPlan> Maker::up(double height) const {
  const FlightLimits& limits = conflict_.limits;
  const double rate = height > 0 ? limits.climb_rate : limits.sink_rate;
  if (!(rate > 0)) return std::nullopt;
  const double climb =
      model::climb_time(std::abs(height), rate, limits.climb_acceleration);
  const double left_at =
      std::max(conflict_.begin, conflict_.meets - kLevelBefore - climb);
  const double level_until = std::min(conflict_.apart + kLevelAfter, end_);
  if (left_at + climb > level_until) return std::nullopt;
  FlightPlan flight = kept_until(left_at);
  const FlightPlan beside = planning::part_of(conflict_.plan, left_at, level_until);
  if (beside.empty()) return std::nullopt;
  const FlightPlan higher =
      model::climbing(beside, beside.front().p_N.z(),
                      model::quickest_climb(height, rate, limits.climb_acceleration));
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
  if (!other.go(flight, at(conflict_.begin), conflict_.begin, at(until)))
    return std::nullopt;
  if (until < end_ && !go_on(flight, goal_)) return std::nullopt;
  return flight;
}

std::optional<FlightPlan> made(const Manoeuvre& manoeuvre,
                               const ConflictOfFlight& conflict) {
  const FlightPlan& plan = conflict.plan;
  const Maker maker(
      conflict,
      planning::part_of(plan, conflict.begin, model::end_time_of(plan)).front().wind);
  switch (manoeuvre.kind) {
    case ManoeuvreKind::kRight:
      return maker.aside(manoeuvre.amount, manoeuvre.lead);
    case ManoeuvreKind::kLeft:
      return maker.aside(-manoeuvre.amount, manoeuvre.lead);
    case ManoeuvreKind::kUp:
      return maker.up(manoeuvre.amount);
    case ManoeuvreKind::kDown:
      return maker.up(-manoeuvre.amount);
    case ManoeuvreKind::kSpeed:
      return maker.speed(manoeuvre.amount);
    default:
      return maker.direct();
  }
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
  const FlightPlan& plan = conflict.plan;
  if (plan.empty() || conflict.begin >= model::end_time_of(plan) ||
      conflict.begin < model::start_of(plan))
    return std::nullopt;
  if (manoeuvre.kind == ManoeuvreKind::kGoOn)
    return planning::part_of(plan, conflict.begin, model::end_time_of(plan));
  const auto flight = made(manoeuvre, conflict);
  return flight && within(*flight, conflict.limits) ? flight : std::nullopt;
}

}  // namespace skein::reasoning
