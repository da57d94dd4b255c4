// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/target/orbit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/climb.h"
#include "skein/solve/path/join.h"
#include "skein/solve/path/limits_check.h"
#include "skein/solve/target/orbit_entry.h"
#include "skein/solve/target/standoff.h"
#include "skein/solve/target/weave.h"

namespace skein::solve {
namespace {

constexpr double kMaxElements = 2e4;  // of a plan

OrbitResult refused(OrbitOutcome outcome, std::string reason) {
  OrbitResult result;
  result.outcome = outcome;
  result.reason = std::move(reason);
  return result;
}

OrbitResult checked(const OrbitQuery& q) {
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  if (std::string error = error_of(q.target); !error.empty())
    return refused(OrbitOutcome::kBadTarget, std::move(error));
  if (!positive(q.radius) || q.radius > kMaxCoordinate || !positive(q.tolerance) ||
      !positive(q.duration) || q.duration > kLongestFlight)
    return refused(
        OrbitOutcome::kBadOrbit,
        "radius, tolerance and duration must be above 0, the radius at most 1e6 m, "
        "the duration at most 1e6 s");
  if (std::string error = limits_error(q.limits); !error.empty())
    return refused(OrbitOutcome::kBadAircraft, std::move(error));
  if (std::string error = speeds_error(q.limits); !error.empty())
    return refused(OrbitOutcome::kBadAircraft, std::move(error));
  if (std::string error = state_error(q.start); !error.empty())
    return refused(OrbitOutcome::kBadAircraft, "start: " + error);
  if (!usable_time(q.start_time) || !(std::abs(q.altitude_msl) <= kMaxCoordinate) ||
      !q.wind.allFinite())
    return refused(OrbitOutcome::kBadAircraft,
                   "altitude, time and wind must be numbers, and not absurd");
  if (std::string error = climb_error(q.altitude_msl + q.start.p_N.z(), q.limits);
      !error.empty())
    return refused(OrbitOutcome::kBadAircraft, std::move(error));
  if (too_windy(q.wind.norm(), q.limits.fastest))
    return refused(OrbitOutcome::kWindTooStrong,
                   too_strong(q.wind.norm(), q.limits.fastest));
  OrbitResult fine;
  fine.outcome = OrbitOutcome::kPlanned;
  return fine;
}

OrbitResult too_fast(double felt, double fastest) {
  return refused(
      OrbitOutcome::kTargetTooFast,
      fmt::format("the target moves through the air at up to {:.1f} m/s; with a "
                  "fastest airspeed of {:.1f} m/s it must be below {:.1f} m/s",
                  felt, fastest, fastest / 1.05));
}

OrbitResult too_long(const OrbitQuery& q, double max) {
  return refused(OrbitOutcome::kBadOrbit,
                 fmt::format("{:.3g} s are too long for turns as short as these: at most "
                             "{:.3g} s",
                             q.duration, max));
}

// The quickest path to the circle, over all its places.
FlightPlan way_to_circle(Standoff& s, const OrbitQuery& q) {
  constexpr int kPlaces = 120;
  const model::AirMotion air{s.speed.airspeed, s.speed.turn_radius, q.wind};
  const auto entry_at = [&](double bearing) {
    return connection_to([&](double t) { return pose_on(s, bearing, t); }, s.target,
                         pose_of(q.start), air, q.start_time, q.start.p_N.z());
  };
  const auto time = [&](double bearing) {
    const FlightPlan plan = entry_at(bearing);
    return plan.empty() ? 1e300 : model::duration(plan);
  };
  struct Best {
    double time = 1e300, bearing = 0;
    int side = 1;
  } best;
  for (const int side : {1, -1}) {
    if (q.side != OrbitSide::kEither && (side == 1) != (q.side == OrbitSide::kClockwise))
      continue;
    s.side = side;
    for (int k = 0; k < kPlaces; ++k) {
      const double bearing = 2 * geo::kPi * k / kPlaces;
      if (const double t = time(bearing); t < best.time) best = {t, bearing, side};
    }
  }
  s.side = best.side;
  // Ever closer around the best place.
  for (double step = geo::kPi / kPlaces; step > 1e-7; step /= 2)
    for (const double bearing : {best.bearing - step, best.bearing + step})
      if (const double t = time(bearing); t < best.time) best = {t, bearing, best.side};
  return best.time < 1e300 ? entry_at(best.bearing) : FlightPlan{};
}

OrbitResult circle(const OrbitQuery& q, double felt) {
  OrbitResult result;
  result.min_radius = min_standoff(q.limits, felt, q.wind.norm());
  const auto speed = speed_for_circle(q.radius, q.limits, felt, q.wind.norm());
  if (!std::isfinite(result.min_radius)) return too_fast(felt, q.limits.fastest);
  if (!speed) {
    result.outcome = OrbitOutcome::kRadiusTooSmall;
    result.reason = fmt::format(
        "a circle of {:.1f} m around the target is too tight; from {:.1f} m on "
        "it can be flown",
        q.radius, result.min_radius);
    return result;
  }
  Standoff s{q.target, q.radius, 1, q.wind, *speed};
  result.airspeed = speed->airspeed;
  FlightPlan entry = way_to_circle(s, q);
  if (entry.empty()) {
    result.outcome = OrbitOutcome::kNotReached;
    result.reason = "no path to the circle was found";
    return result;
  }
  result.entry_time = model::end_time_of(entry);
  const FlightState there = end_state(entry);
  const double down = q.start.p_N.z();
  const auto around = [&](double duration, double step) {
    return along_circle(s, pose_of(there), result.entry_time, duration, step, down);
  };
  // A sixteenth of a circle, then ever shorter, until that is enough for the first
  // circles.
  double step = q.radius / speed->airspeed * geo::kPi / 8;
  if (q.duration / step > kMaxElements) return too_long(q, step * kMaxElements);
  const double circles = 4 * geo::kPi * q.radius / (speed->airspeed - felt);
  const double tried =
      q.target.track.empty() ? std::min(q.duration, circles) : q.duration;
  for (int k = 0; k < 8 && q.duration / (step / 2) <= kMaxElements; ++k) {
    if (largest_error(s, around(tried, step)) <= q.tolerance) break;
    step /= 2;
  }
  const FlightPlan circling = around(q.duration, step);
  result.largest_error = largest_error(s, circling);
  result.plan = std::move(entry);
  result.plan.insert(result.plan.end(), circling.begin(), circling.end());
  result.outcome = OrbitOutcome::kPlanned;
  if (result.largest_error > q.tolerance) {
    result.outcome = OrbitOutcome::kOutsideTolerance;
    result.reason = fmt::format(
        "the distance to the target is up to {:.2f} m off{}", result.largest_error,
        q.target.track.empty() ? "" : ", where its velocity changes");
  }
  return result;
}

OrbitResult weave(const OrbitQuery& q, double felt) {
  const double min = 1.05 * std::max(felt, q.wind.norm());
  if (min > q.limits.fastest) return too_fast(felt, q.limits.fastest);
  OrbitResult result;
  result.airspeed = std::max(q.limits.airspeed, min);
  const model::AirMotion air{result.airspeed, turn_radius_at(result.airspeed, q.limits),
                             q.wind};
  // The minimum turn takes this long, with the target as fast as it may be.
  const double turn = 2 * weave_angle(1 / 1.05) * air.turn_radius / air.airspeed;
  if (q.duration / turn > kMaxElements) return too_long(q, turn * kMaxElements);
  result.plan = weave_along(q.target, pose_of(q.start), air, q.start_time, q.duration,
                            q.start.p_N.z(), result.entry_time);
  if (result.plan.empty()) {
    result.outcome = OrbitOutcome::kNotReached;
    result.reason = "no path to the target was found";
    return result;
  }
  result.outcome = OrbitOutcome::kPlanned;
  return result;
}

// Distances to the target after the entry.
void measure(const MovingTarget& target, OrbitResult& result) {
  result.nearest = 1e300;
  for (const FlightElement& e : result.plan)
    for (int k = 0; k <= 16; ++k) {
      const double t = e.duration * k / 16;
      if (e.start + t < result.entry_time - 1e-9) continue;
      const double d =
          (geo::horizontal(model::position(e, t)) - position_at(target, e.start + t))
              .norm();
      result.nearest = std::min(result.nearest, d);
      result.farthest = std::max(result.farthest, d);
    }
}

}  // namespace

std::string_view name_of(OrbitOutcome outcome) {
  constexpr std::array<std::string_view, 9> kNames = {
      "planned",          "outside-tolerance", "target-too-fast",
      "radius-too-small", "not-reached",       "wind-too-strong",
      "bad-target",       "bad-orbit",         "bad-aircraft"};
  return kNames[static_cast<std::size_t>(outcome)];
}

OrbitResult plan_orbit(const OrbitQuery& query) {
  OrbitResult result = checked(query);
  if (result.outcome != OrbitOutcome::kPlanned) return result;
  const double felt = strongest_wind(query.target, query.wind, query.start_time);
  result = query.kind == OrbitKind::kCircle ? circle(query, felt) : weave(query, felt);
  if (result.plan.empty()) return result;
  measure(query.target, result);
  if (!climb_along(result.plan, query.start.p_N.z(), -query.altitude_msl, query.limits)) {
    result.outcome = OrbitOutcome::kBadOrbit;
    result.reason =
        "the plan ends before the orbit's altitude is reached; a longer duration "
        "gives the time";
  }
  return result;
}

}  // namespace skein::solve
