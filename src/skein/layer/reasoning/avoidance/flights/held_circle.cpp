// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/flights/held_circle.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "skein/geo/vec.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr double kFullTurn = 0.95;  // of a turn: what is sent is rounded
constexpr double kShort = 3;        // of straight pieces within it [s]
constexpr double kLevel = 0.3;      // climb rate that is none [m/s]
constexpr double kStep = 1;         // between places of a circle that are looked at [s]

}  // namespace

std::optional<HeldCircle> circle_at_end(const FlightPlan& plan) {
  if (plan.empty()) return std::nullopt;
  double side = 0, turned = 0;
  auto first = plan.end();
  while (first != plan.begin() && turned < 2 * geo::kPi * kFullTurn) {
    const FlightElement& e = *std::prev(first);
    const bool turns = e.turn_rate != 0;
    if (turns && side == 0) side = e.turn_rate;
    if (std::abs(e.climb_rate) > kLevel || (turns && !(e.turn_rate * side > 0)) ||
        (!turns && e.duration > kShort))
      return std::nullopt;
    turned += std::abs(e.turn_rate) * e.duration;
    --first;
  }
  if (turned < 2 * geo::kPi * kFullTurn) return std::nullopt;
  const double from = first->start, until = model::end_time_of(plan);
  Vec2 low = geo::horizontal(first->p_N), high = low;
  for (double time = from; time < until; time += kStep) {
    const Vec2 place = geo::horizontal(model::moment_at(plan, time).p_N);
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  HeldCircle circle;
  circle.centre = (low + high) / 2;
  circle.down = model::end_of(plan.back()).p_N.z();
  for (double time = from; time < until; time += kStep)
    circle.radius = std::max(
        circle.radius,
        (geo::horizontal(model::moment_at(plan, time).p_N) - circle.centre).norm());
  return circle;
}

bool are_apart(const HeldCircle& a, const HeldCircle& b, const Separation& kept) {
  return (a.centre - b.centre).norm() >= a.radius + b.radius + kept.horizontal ||
         std::abs(a.down - b.down) >= kept.vertical;
}

}  // namespace skein::reasoning
