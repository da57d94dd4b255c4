// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/target/rendezvous.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "skein/solve/path/limits_check.h"
#include "skein/solve/target/arrival_order.h"

namespace skein::solve {
namespace {

RendezvousResult refused(RendezvousOutcome outcome, std::string reason) {
  RendezvousResult result;
  result.outcome = outcome;
  result.reason = std::move(reason);
  return result;
}

std::string error_of(const RendezvousAircraft& a) {
  if (std::string error = limits_error(a.limits); !error.empty()) return error;
  if (std::string error = speeds_error(a.limits); !error.empty()) return error;
  for (const FlightState& state : {a.start, a.goal})
    if (std::string error = state_error(state); !error.empty())
      return "start or goal: " + error;
  if (!usable_time(a.start_time)) return "the start time is not a usable number";
  if (std::string error = climb_error(a.start.p_N.z() - a.goal.p_N.z(), a.limits);
      !error.empty())
    return error;
  return {};
}

}  // namespace

std::string_view name_of(RendezvousOutcome outcome) {
  constexpr std::array<std::string_view, 6> kNames = {
      "planned", "too-early", "gap", "bad-aircraft", "bad-query", "wind-too-strong"};
  return kNames[static_cast<std::size_t>(outcome)];
}

RendezvousResult plan_rendezvous(const RendezvousQuery& query) {
  using Outcome = RendezvousOutcome;
  if (query.aircraft.empty()) return refused(Outcome::kBadQuery, "there is no aircraft");
  if (!(query.spacing >= 0) || query.spacing > kLongestFlight ||
      (query.time && !usable_time(*query.time)) || !query.wind.allFinite())
    return refused(Outcome::kBadQuery,
                   "time, spacing and wind must be numbers, the spacing at least 0");
  std::vector<TimedLeg> legs;
  for (std::size_t k = 0; k < query.aircraft.size(); ++k) {
    const RendezvousAircraft& a = query.aircraft[k];
    if (std::string error = error_of(a); !error.empty())
      return refused(Outcome::kBadAircraft, fmt::format("aircraft {}: {}", k, error));
    legs.push_back(
        {a.start, a.goal, a.start_time, a.limits, query.wind, query.any_airspeed});
    if (query.time && *query.time - a.start_time > kLongestFlight)
      return refused(
          Outcome::kBadQuery,
          fmt::format("the time is more than {:.0f} s after the start of aircraft {}",
                      kLongestFlight, k));
    if (!std::isfinite(earliest_arrival(legs.back())))
      return refused(Outcome::kWindTooStrong,
                     fmt::format("aircraft {}: {}", k,
                                 too_strong(query.wind.norm(), query.any_airspeed
                                                                   ? a.limits.fastest
                                                                   : a.limits.airspeed)));
  }
  const Arrivals arrivals = arrive_in_order(legs, query.time, query.spacing);
  RendezvousResult result;
  result.earliest = arrivals.earliest;
  if (arrivals.status != TimedStatus::kFound) {
    const bool early = arrivals.status == TimedStatus::kTooEarly;
    result.outcome = early ? Outcome::kTooEarly : Outcome::kGap;
    result.reason = fmt::format("{} at {:.2f} s; {:.2f} s is the {} time that was found",
                                early ? "not all can be there" : "somebody cannot arrive",
                                query.time.value_or(arrivals.earliest), arrivals.earliest,
                                early ? "earliest" : "next");
    return result;
  }
  result.outcome = Outcome::kPlanned;
  for (const TimedFlight& flight : arrivals.flights) {
    result.plans.push_back(flight.plan);
    result.airspeeds.push_back(flight.airspeed);
  }
  result.arrivals = arrivals.times;
  return result;
}

}  // namespace skein::solve
