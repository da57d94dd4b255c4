// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/traffic/intruder_flight.h"

#include <algorithm>
#include <cmath>

namespace skein::environment {
namespace {

constexpr double kMaxStep = 0.25;  // [s]
constexpr double kCatchUp = 10;    // time constant of closing up from behind [s]
constexpr double kNear = 1;        // its direction is none [m]
constexpr double kBrakes = 0.4;    // of its acceleration, while it closes up

}  // namespace

IntruderFlight::IntruderFlight(const Vec3& begin, const IntruderOptions& options,
                               EntityId whom)
    : options_(options), whom_(whom), motion_(begin, options.course, options.slowest) {
  setpoint_ = {options.course, options.slowest, -begin.z()};
  state_ = {begin, motion_.v_N()};
}

void IntruderFlight::aim(const NoticedAircraft& other) {
  const Vec2 place = geo::horizontal(other.p_N), velocity = geo::horizontal(other.v_N);
  const Vec2 here = geo::horizontal(motion_.p_N());
  const double speed = velocity.norm();
  const Vec2 ahead = speed > 0 ? Vec2(velocity / speed) : Vec2(Vec2::Zero());
  const Vec2 station = place - options_.distance * ahead;
  const double away = (station - here).norm();
  const double lead = std::min(away / options_.fastest, options_.lead);
  const Vec2 to_go = station + lead * velocity - here;
  if (to_go.norm() > kNear) setpoint_.course = geo::bearing(to_go);
  // No faster than what it can brake in time, or it would fly past and circle back.
  const double closing = std::min(
      away / kCatchUp, std::sqrt(2 * kBrakes * options_.limits.acceleration * away));
  setpoint_.speed = std::clamp(speed + closing, options_.slowest, options_.fastest);
  setpoint_.altitude = -other.p_N.z() + options_.above;
}

void IntruderFlight::advance(const TrafficView& view) {
  const auto other =
      std::find_if(view.aircraft.begin(), view.aircraft.end(),
                   [this](const NoticedAircraft& each) { return each.id == whom_; });
  if (other != view.aircraft.end()) aim(*other);
  const double gone = (view.now - now_).seconds();
  now_ = view.now;
  if (gone <= 0) return;
  for (double left = gone; left > 0;) {
    const double dt = std::min(left, kMaxStep);
    motion_.step(setpoint_, options_.limits, dt);
    left -= dt;
  }
  state_.p_N = motion_.p_N();
  state_.v_N = motion_.v_N();
}

}  // namespace skein::environment
