// SPDX-License-Identifier: Apache-2.0
#include "skein/model/connection/airplane.h"

#include <cmath>
#include <limits>

#include "skein/model/connection/arrival.h"
#include "skein/model/path/climb_profile.h"
#include "skein/model/path/flight_plan.h"

namespace skein::model {
namespace {

// Times that cannot be met are followed by later ones, first this part of a circle later
// and then by steps that grow; where the goal drifts off nearly as fast as the aircraft
// flies it takes long until it can be met again.
constexpr double kFirstStep = 1.0 / 16;
constexpr double kGrowth = 1.15;
constexpr int kMaxCircleSteps = 150;  // 1e9 circles
constexpr int kHalvings = 40;
constexpr double kLongestClimb = 1e8;  // climb, in turn radii of flight

Pose pose_of(const FlightState& state) {
  return {geo::horizontal(state.p_N), state.heading};
}

// The first arrival at `time` or later; not found when it takes longer than any flight.
Arrival next_arrival(const Pose& from, const Pose& to, const AirMotion& air, double time,
                     double step) {
  double missed = time;
  Arrival arrival = connect_at(from, to, air, time);
  if (arrival.status == ArrivalStatus::kFound) return arrival;
  for (int i = 0; arrival.status != ArrivalStatus::kFound; ++i) {
    if (i == kMaxCircleSteps) return arrival;
    missed = time;
    time += step;
    step *= kGrowth;
    arrival = connect_at(from, to, air, time);
  }
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (missed + time) / 2;
    Arrival earlier = connect_at(from, to, air, middle);
    const bool met = earlier.status == ArrivalStatus::kFound;
    (met ? time : missed) = middle;
    if (met) arrival = std::move(earlier);
  }
  return arrival;
}

}  // namespace

SpaceConnection connect(const FlightState& from, const FlightState& to,
                        const AirMotion& air, const ClimbLimits& limits) {
  SpaceConnection result;
  result.time = std::numeric_limits<double>::infinity();
  const double climb = from.p_N.z() - to.p_N.z();
  if (!std::isfinite(climb) || !(limits.climb_rate > 0) || !(limits.sink_rate > 0) ||
      !(limits.acceleration >= 0))
    return result;
  const Pose start = pose_of(from), goal = pose_of(to);
  const Connection level = connect(start, goal, air);
  result.status = level.status;
  if (level.status != ConnectionStatus::kFound) return result;

  const double needed =
      climb_time(std::abs(climb), climb > 0 ? limits.climb_rate : limits.sink_rate,
                 limits.acceleration);
  if (needed <= level.time) {
    result.time = level.time;
    result.plan = climbing(to_flight_plan(level, start, air), from.p_N.z(),
                           even_climb(climb, level.time, limits.acceleration));
    return result;
  }
  if (!(needed * air.airspeed <= kLongestClimb * air.turn_radius)) {
    result.status = ConnectionStatus::kBadInput;
    return result;
  }
  const double circle = 2 * geo::kPi * air.turn_radius / air.airspeed;
  const Arrival arrival = next_arrival(start, goal, air, needed, circle * kFirstStep);
  if (arrival.status != ArrivalStatus::kFound) {
    result.status = ConnectionStatus::kBadInput;
    return result;
  }
  result.time = duration(arrival.plan);
  result.altitude =
      result.time - level.time < circle ? AltitudeCase::kMedium : AltitudeCase::kHigh;
  result.plan = climbing(arrival.plan, from.p_N.z(),
                         even_climb(climb, result.time, limits.acceleration));
  return result;
}

}  // namespace skein::model
