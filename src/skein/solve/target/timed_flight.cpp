// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/target/timed_flight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "skein/model/connection/arrival.h"
#include "skein/model/path/climb_profile.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/join.h"
#include "skein/solve/target/standoff.h"

namespace skein::solve {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr int kSpeeds = 32;     // that are tried on either side of cruise
constexpr double kNear = 1e-9;  // of a flight's duration, that an arrival may be off

model::AirMotion air_at(const TimedLeg& leg, double airspeed) {
  return {airspeed, turn_radius_at(airspeed, leg.limits), leg.wind};
}

double quickest(const TimedLeg& leg, double airspeed) {
  return model::connect(pose_of(leg.from), pose_of(leg.to), air_at(leg, airspeed)).time;
}

double climb_of(const TimedLeg& leg) {
  return leg.from.p_N.z() - leg.to.p_N.z();
}

// Time that the altitude takes at least [s].
double climb_time(const TimedLeg& leg) {
  const double climb = climb_of(leg);
  if (std::abs(climb) < 1e-9) return 0;
  const double rate = climb > 0 ? leg.limits.climb_rate : leg.limits.sink_rate;
  return model::climb_time(std::abs(climb), rate, leg.limits.climb_acceleration);
}

// Allowed airspeeds from cruise to the slowest or the fastest.
std::vector<double> speeds_towards(const TimedLeg& leg, double end) {
  const double min = kWindReserve * leg.wind.norm();
  const double cruise = leg.limits.airspeed;
  std::vector<double> speeds;
  for (int k = 0; k <= kSpeeds; ++k) {
    const double v = cruise + (end - cruise) * k / kSpeeds;
    if (v > 0 && v >= min) speeds.push_back(v);
    if (!leg.any_airspeed || end == cruise) break;
  }
  // The last one before the wind is too strong.
  if (leg.any_airspeed && end < cruise && min > end && min < cruise)
    speeds.push_back(min);
  return speeds;
}

// The airspeed between two at which the quickest path takes `duration`; 0 when that
// jumps.
double speed_between(const TimedLeg& leg, double a, double b, double duration) {
  const bool falls = quickest(leg, a) > quickest(leg, b);
  for (int i = 0; i < 100; ++i) {
    const double middle = (a + b) / 2;
    ((quickest(leg, middle) > duration) == falls ? a : b) = middle;
  }
  for (const double v : {a, b})
    if (std::abs(quickest(leg, v) - duration) <= kNear * duration) return v;
  return 0;
}

struct Quickest {
  double time = kNever;  // [s]
  double airspeed = 0;   // [m/s]
};

// The quickest path over all airspeeds: those of the lists, then ever closer to the best.
Quickest quickest_of_all(const TimedLeg& leg) {
  Quickest best;
  const auto look = [&](double v) {
    if (const double t = quickest(leg, v); t < best.time) best = {t, v};
  };
  for (const double end : {leg.limits.slowest, leg.limits.fastest})
    for (const double v : speeds_towards(leg, end)) look(v);
  if (!leg.any_airspeed || best.time == kNever) return best;
  const double max = leg.limits.fastest;
  const double min = std::max(leg.limits.slowest, kWindReserve * leg.wind.norm());
  for (double step = (max - min) / kSpeeds; step > 1e-9; step /= 2)
    for (const double v : {best.airspeed - step, best.airspeed + step})
      if (v >= min && v <= max && v > 0) look(v);
  return best;
}

FlightPlan finished(const TimedLeg& leg, FlightPlan plan) {
  plan = model::starting_at(std::move(plan), leg.start);
  double climb = climb_of(leg);
  if (std::abs(climb) < 1e-9) climb = 0;
  return model::climbing(
      plan, leg.from.p_N.z(),
      model::even_climb(climb, model::duration(plan), leg.limits.climb_acceleration));
}

bool take(const TimedLeg& leg, double airspeed, FlightPlan plan, TimedFlight& flight) {
  flight.status = TimedStatus::kFound;
  flight.airspeed = airspeed;
  flight.plan = finished(leg, std::move(plan));
  return true;
}

// By the connection at one airspeed.
bool by_connection(const TimedLeg& leg, double airspeed, double duration,
                   TimedFlight& flight) {
  if (std::abs(quickest(leg, airspeed) - duration) > kNear * duration) return false;
  const model::AirMotion air = air_at(leg, airspeed);
  const model::Pose from = pose_of(leg.from);
  return take(
      leg, airspeed,
      model::to_flight_plan(model::connect(from, pose_of(leg.to), air), from, air),
      flight);
}

// By airspeed alone.
bool by_airspeed(const TimedLeg& leg, double duration, TimedFlight& flight) {
  for (const double end : {leg.limits.slowest, leg.limits.fastest}) {
    const std::vector<double> speeds = speeds_towards(leg, end);
    for (std::size_t k = 0; k < speeds.size(); ++k) {
      double v = 0;
      if (std::abs(quickest(leg, speeds[k]) - duration) <= kNear * duration)
        v = speeds[k];
      else if (k > 0 && (quickest(leg, speeds[k - 1]) > duration) !=
                            (quickest(leg, speeds[k]) > duration))
        v = speed_between(leg, speeds[k - 1], speeds[k], duration);
      if (v > 0 && by_connection(leg, v, duration, flight)) return true;
    }
  }
  return false;
}

// By a detour, at the slowest airspeed that can make one of that length.
bool by_detour(const TimedLeg& leg, double duration, TimedFlight& flight) {
  std::vector<double> speeds = speeds_towards(leg, leg.limits.slowest);
  std::reverse(speeds.begin(), speeds.end());
  const std::vector<double> faster = speeds_towards(leg, leg.limits.fastest);
  speeds.insert(speeds.end(), faster.begin(), faster.end());
  // A few of them: what one cannot fly another mostly can.
  for (std::size_t k = 0; k < speeds.size(); k += kSpeeds / 4) {
    const double v = speeds[k];
    model::Arrival arrival =
        model::connect_at(pose_of(leg.from), pose_of(leg.to), air_at(leg, v), duration);
    if (arrival.status == model::ArrivalStatus::kFound)
      return take(leg, v, std::move(arrival.plan), flight);
  }
  return false;
}

bool found(const TimedLeg& leg, double duration, TimedFlight& flight) {
  return by_airspeed(leg, duration, flight) || by_detour(leg, duration, flight);
}

}  // namespace

double earliest_arrival(const TimedLeg& leg) {
  return leg.start + std::max(quickest_of_all(leg).time, climb_time(leg));
}

TimedFlight arrive_at(const TimedLeg& leg, double time) {
  TimedFlight flight;
  const Quickest best = quickest_of_all(leg);
  flight.earliest = leg.start + std::max(best.time, climb_time(leg));
  flight.next = flight.earliest;
  if (!std::isfinite(flight.earliest)) return flight;
  const double duration = time - leg.start;
  flight.status = TimedStatus::kTooEarly;
  if (time < flight.earliest - kNear * std::max(1.0, duration)) return flight;
  flight.next = time;
  if (by_connection(leg, best.airspeed, duration, flight) || found(leg, duration, flight))
    return flight;
  // The next time that can be met; with two full circles more all can.
  flight.status = TimedStatus::kGap;
  const double circle = 4 * geo::kPi * leg.limits.turn_radius / leg.limits.airspeed;
  TimedFlight later;
  for (int k = 1; k <= 64; ++k) {
    flight.next = time + circle * k / 64;
    if (found(leg, flight.next - leg.start, later)) break;
  }
  return flight;
}

}  // namespace skein::solve
