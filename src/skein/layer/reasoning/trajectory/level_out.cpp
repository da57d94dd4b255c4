// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/level_out.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr double kBanked = geo::radians(10);    // from such a roll on it levels out
constexpr double kSteepest = geo::radians(75);  // more is no turn
constexpr double kRollRate = geo::radians(30);  // that aircraft roll at

FlightElement straight_from(const NavEstimate& nav, const FlightLimits& limits,
                            const FlightState& from, double time) {
  FlightElement element;
  element.start = time;
  element.p_N = from.p_N;
  element.heading = from.heading;
  element.airspeed = limits.airspeed;
  element.wind = nav.wind_N;
  return element;
}

}  // namespace

std::optional<FlightElement> level_out(const NavEstimate& nav, const FlightLimits& limits,
                                       const FlightState& from, double time) {
  if (limits.slowest <= 0 || std::abs(nav.roll) < kBanked) return std::nullopt;
  FlightElement element = straight_from(nav, limits, from, time);
  element.duration = std::min(std::abs(nav.roll), kSteepest) / kRollRate;
  return element;
}

FlightState state_when_level(const NavEstimate& nav, const FlightLimits& limits,
                             double delay) {
  FlightState state{nav.p_N, nav.heading};
  if (limits.slowest <= 0) return state;
  FlightElement turn = straight_from(nav, limits, state, 0);
  const double roll = std::clamp(nav.roll, -kSteepest, kSteepest);
  turn.turn_rate = kGravity * math::tan(roll) / std::max(1.0, limits.airspeed);
  turn.duration = delay;
  const model::FlightMoment after = model::end_of(turn);
  state = {after.p_N, after.heading};
  if (const auto level = level_out(nav, limits, state, 0))
    state.p_N = model::end_of(*level).p_N;
  return state;
}

}  // namespace skein::reasoning
