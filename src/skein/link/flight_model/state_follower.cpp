// SPDX-License-Identifier: Apache-2.0
#include "skein/link/flight_model/state_follower.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace skein::flight_model {
namespace {

constexpr double kSmoothing = 1;         // of the difference of the clocks [s]
constexpr double kMaxDifference = 0.25;  // that is smoothed [s]
constexpr double kRoom = 50;             // off where it can be [m]
constexpr double kAcceleration = 50;     // that it may have had in between [m/s^2]
constexpr double kLongGap = 5;           // after it nobody knows where it can be [s]
constexpr double kFuelStep = 0.01;       // less is no news

}  // namespace

// Why this is no continuation of the flight before.
std::optional<std::string> StateFollower::jump(const FlightState& state,
                                               const Vec3& p_N) const {
  const double dt = state.time - before_->state.time;
  if (dt < 0) return fmt::format("its clock went back by {:.1f} s", -dt);
  if (dt > kLongGap) return std::nullopt;
  const Vec3 expected = before_->p_N + dt * (before_->state.v_N + state.v_N) / 2;
  const double off = (p_N - expected).norm();
  if (off <= kRoom + kAcceleration * dt * dt / 2) return std::nullopt;
  return fmt::format("it is {:.0f} m from where it can have flown to", off);
}

Time StateFollower::align(double time, Time came) {
  const double difference = came.seconds() - time;
  if (!offset_ || std::abs(difference - *offset_) > kMaxDifference) {
    offset_ = difference;
  } else if (before_) {
    const double dt = std::clamp((came - before_->came).seconds(), 0.0, kSmoothing);
    *offset_ += dt / kSmoothing * (difference - *offset_);
  }
  return Time::from_seconds(time + *offset_);
}

void StateFollower::take(const FlightState& state, Time came,
                         std::vector<VehicleReport>& out) {
  if (before_ && state.time == before_->state.time) return;
  const Vec2 plane = frame_.to_plane(state.place.latitude_deg, state.place.longitude_deg);
  const Vec3 p_N(plane.x(), plane.y(), -state.place.height_m);
  if (before_) {
    if (auto why = jump(state, p_N)) {
      out.emplace_back(LinkChange{LinkChange::Kind::kRebooted, *std::move(why)});
      offset_.reset();
    }
  }
  VehicleCondition condition;
  condition.armed = true;
  condition.position = true;
  condition.on_ground = state.on_ground;
  condition.charge = state.fuel;
  if (!reported_ || reported_->on_ground != condition.on_ground ||
      std::abs(reported_->charge - condition.charge) >= kFuelStep) {
    reported_ = condition;
    out.emplace_back(condition);
  }
  VehicleMotion motion;
  motion.time = align(state.time, came);
  motion.p_N = p_N;
  motion.v_N = state.v_N;
  motion.q_NB = state.q_NB;
  motion.w_NB_B = state.w_NB_B;
  motion.airspeed = (state.v_N - state.wind_N).norm();
  motion.wind_N = state.wind_N.head<2>();
  out.emplace_back(motion);
  before_ = Before{state, p_N, came};
}

}  // namespace skein::flight_model
