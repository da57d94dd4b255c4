// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/traffic/wandering_flight.h"

#include <algorithm>
#include <cmath>

namespace skein::environment {
namespace {

constexpr double kStep = 0.5;     // [s]
constexpr double kMinLeg = 5;     // [s]
constexpr double kReached = 300;  // a waypoint [m]

}  // namespace

WanderingFlight::WanderingFlight(const Vec3& begin, const WanderingOptions& options,
                                 std::uint64_t seed, std::uint32_t traffic)
    : options_(options),
      random_(seed, traffic, Purpose::kTraffic),
      home_(geo::horizontal(begin)),
      motion_(begin, random_.uniform(-geo::kPi, geo::kPi),
              random_.uniform(options.slowest, options.fastest)),
      from_(begin) {
  decide();
  advance({});
}

void WanderingFlight::decide() {
  const double bearing = random_.uniform(-geo::kPi, geo::kPi);
  const double reach = options_.radius * std::sqrt(random_.uniform());
  waypoint_ = home_ + reach * geo::unit(bearing);
  setpoint_.speed = random_.uniform(options_.slowest, options_.fastest);
  setpoint_.altitude = random_.uniform(options_.lowest, options_.highest);
  const double leg = -options_.mean_leg * math::log(1 - random_.uniform());
  leg_end_ = static_cast<double>(steps_) * kStep + std::max(leg, kMinLeg);
}

void WanderingFlight::step() {
  const Vec2 to_go = waypoint_ - geo::horizontal(motion_.p_N());
  if (static_cast<double>(steps_) * kStep >= leg_end_ || to_go.norm() < kReached)
    decide();
  setpoint_.course = geo::bearing(waypoint_ - geo::horizontal(motion_.p_N()));
  from_ = motion_.p_N();
  motion_.step(setpoint_, options_.limits, kStep);
  ++steps_;
}

void WanderingFlight::advance(const TrafficView& view) {
  now_ = view.now.seconds();
  while (static_cast<double>(steps_) * kStep <= now_) step();
  const double since = now_ - static_cast<double>(steps_ - 1) * kStep;
  state_.v_N = (motion_.p_N() - from_) / kStep;
  state_.p_N = from_ + since * state_.v_N;
}

}  // namespace skein::environment
