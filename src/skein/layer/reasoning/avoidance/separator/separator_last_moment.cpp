// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "skein/layer/reasoning/avoidance/encounter/plan_encounter.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/flight_check.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/manoeuvred_flight.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/replanned_flight.h"
#include "skein/layer/reasoning/avoidance/separator/separator.h"
#include "skein/layer/reasoning/avoidance/separator/separator_common.h"
#include "skein/model/path/climb_profile.h"
#include "skein/model/path/flight_plan.h"
#include "skein/role/terrain.h"
#include "skein/solve/path/repair.h"

// What each does at the last moment, when nothing can be said any more.

namespace skein::reasoning {
namespace {

constexpr double kLongest = 15;       // away from the plan [s]
constexpr double kHeights = 1.5;      // vertical separations, up or down
constexpr double kSameHeight = 1;     // [m]
constexpr double kClearlyOver = 3;    // more than heights are wrong by [m]
constexpr double kGroundAhead = 500;  // that is looked at [m]
constexpr double kGroundStep = 50;    // [m]
constexpr double kWorthATurn = 0.05;  // of the ratio that is kept
constexpr std::array kTurns = {0.0, 30.0, -30.0, 60.0, -60.0, 90.0, -90.0};  // [deg]

// The least ratio that a flight keeps to others; 1: it does not come too near.
double kept_by(const FlightPlan& flight, std::span<const KnownFlight> others, double from,
               double until) {
  double least = 1;
  for (const KnownFlight& other : others)
    if (const auto met =
            first_encounter(flight, *other.plan, other.separation, from, until))
      least = std::min(least, met->min_ratio);
  return least;
}

}  // namespace

// An altitude, or as much higher as the ground ahead asks for.
double Separator::safe_altitude(const SeparationStep& step, double course,
                                double altitude) const {
  if (!step.query.terrain) return altitude;
  double floor = altitude;
  for (double ahead = 0; ahead <= kGroundAhead; ahead += kGroundStep) {
    const Vec2 place = geo::horizontal(step.p_N) + ahead * geo::unit(course);
    floor = std::max(
        floor, step.query.terrain->elevation_msl(place) + step.query.ground_clearance);
  }
  return floor;
}

// The higher climbs, the lower sinks: by where both are, as far as that is clear, as
// plans may be new and not heard of; else by their plans for when they are closest. At
// one height the lower id climbs.
bool Separator::climbs_away(const SeparationStep& step, const TeamFlight& other,
                            const FlightPlan& theirs, double closest) const {
  const double now = step.now.seconds();
  double over = model::moment_at(theirs, now).p_N.z() - step.p_N.z();
  if (other.place) {
    const double age = (step.now - other.place->sent).seconds();
    over = other.place->p_N.z() + other.place->v_N.z() * age - step.p_N.z();
  }
  if (std::abs(over) > kClearlyOver) return over > 0;
  const double then = std::max(now, closest);
  const double later =
      model::moment_at(theirs, then).p_N.z() - model::moment_at(own_.plan, then).p_N.z();
  if (std::abs(later) > kSameHeight) return later > 0;
  return std::abs(over) > kSameHeight ? over > 0 : self_ < other.who;
}

// Up or down, and aside where that keeps more, straight on until the other has passed.
bool Separator::at_the_last_moment(const SeparationStep& step, const Conflict& conflict) {
  const TeamFlight* other = team_.find(conflict.other);
  if (!other) return false;
  const TeamFlight::Expected expected = other->expected(step.now);
  if (!expected.plan) return false;
  const double now = step.now.seconds();
  const bool up =
      climbs_away(step, *other, *expected.plan, conflict.encounter.closest_time);
  const std::vector<KnownFlight> others = known_but(self_, step.now);  // all others
  FlightCheck check(step.query, step.zones);
  std::optional<FlightPlan> best;
  double most = 0;
  for (const double turn : kTurns) {
    auto flight = flight_aside(step, conflict, geo::radians(turn), up);
    if (!flight) continue;
    const double kept =
        kept_by(*flight, others, now, conflict.encounter.end + kClearTime);
    // No turn leads into a zone or the ground.
    if (best && (kept < most + kWorthATurn || !check.is_free(*flight))) continue;
    best = std::move(flight);
    most = kept;
  }
  if (!best) return false;
  last_moment_until_ = Time::from_seconds(
      std::min(conflict.encounter.closest_time + kClearTime, now + kLongest));
  adopt(*best,
        {now, rejoins(conflict.encounter.end + kRejoinsAfter), conflict.encounter.end,
         SeparationMethod::kLastMoment, conflict.other, 0,
         up ? "climbs away at the last moment" : "sinks away at the last moment"},
        step.now);
  return true;
}

// From where the aircraft is, turned at once, higher or lower, and then on.
std::optional<FlightPlan> Separator::flight_aside(const SeparationStep& step,
                                                  const Conflict& conflict, double turn,
                                                  bool up) const {
  const double now = step.now.seconds();
  const double course = geo::wrap_pi(geo::bearing(step.v_N.head<2>()) + turn);
  const double height = (up ? 1 : -1) * kHeights * conflict.separation.vertical;
  const double climb = safe_altitude(step, course, -step.p_N.z() + height) + step.p_N.z();
  const NegotiatingFlight own = leaving_for(conflict, step.query);
  const FlightPlan part = solve::part_of(own_.plan, now, own.rejoins);
  if (part.empty()) return std::nullopt;
  const double rate = climb > 0 ? own.limits.climb_rate : own.limits.sink_rate;
  const double lasts =
      model::climb_time(std::abs(climb), rate, own.limits.climb_acceleration);
  const double apart =
      std::clamp(conflict.encounter.closest_time, now, now + kLongest) + lasts;
  ConflictOfFlight of_flight{part, own.limits, now, now, now, apart, conflict.separation};
  const auto level =
      turned_on_flight(of_flight, {step.p_N, step.v_N}, turn, apart + kClearTime - now);
  if (!level) return std::nullopt;
  const ConflictOfFlight of_level{*level, own.limits,         now, now, now,
                                  apart,  conflict.separation};
  auto flight = manoeuvred(
      {climb > 0 ? ManoeuvreKind::kUp : ManoeuvreKind::kDown, std::abs(climb), 0},
      of_level);
  if (flight) append_rest(*flight, own_.plan, own.rejoins);
  return flight;
}

}  // namespace skein::reasoning
