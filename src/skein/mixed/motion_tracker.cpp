// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/motion_tracker.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"

namespace skein::mixed {
namespace {

constexpr double kBelievedTurn = 1.5;  // [s]
constexpr double kAcceleration = 2;    // that nobody knows of [m/s^2]
constexpr double kMinSpeed = 3;        // below it a bank says nothing of the course [m/s]

Vec2 turned(const Vec2& v, double angle) {
  const double c = math::cos(angle), s = math::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

}  // namespace

void MotionTracker::add(const VehicleMotion& motion) {
  if (!motion_ || motion.time >= motion_->time) motion_ = motion;
}

VehicleMotion MotionTracker::at(Time now) const {
  VehicleMotion m = *motion_;
  const double age = std::max((now - m.time).seconds(), 0.0);
  const Vec2 v = geo::horizontal(m.v_N);
  const double speed = v.norm();
  const double roll = geo::to_euler(m.q_NB).roll;
  const double rate =
      turns_by_banking_ && speed > kMinSpeed ? kGravity * math::tan(roll) / speed : 0.0;
  const double turning = std::min(age, kBelievedTurn), half = rate * turning / 2;
  const double sinc = std::abs(half) > 1e-6 ? math::sin(half) / half : 1.0;
  const Vec2 after = turned(v, 2 * half);
  const Vec2 moved = turning * sinc * turned(v, half) + (age - turning) * after;
  m.p_N.head<2>() += moved;
  m.p_N.z() += age * m.v_N.z();
  m.v_N.head<2>() = after;
  m.q_NB = geo::from_euler({0, 0, 2 * half}) * m.q_NB;
  const double unknown = kAcceleration * age * age / 2;
  m.position_sd = math::hypot(m.position_sd, unknown);
  m.altitude_sd = math::hypot(m.altitude_sd, unknown);
  m.time = std::max(now, m.time);
  return m;
}

NavEstimate as_estimate(const VehicleMotion& motion) {
  const geo::Euler attitude = geo::to_euler(motion.q_NB);
  NavEstimate nav;
  nav.time = motion.time;
  nav.p_N = motion.p_N;
  nav.v_N = motion.v_N;
  nav.heading = attitude.yaw;
  nav.wind_N = motion.wind_N;
  nav.position_sd = motion.position_sd;
  nav.altitude_sd = motion.altitude_sd;
  nav.roll = attitude.roll;
  nav.pitch = attitude.pitch;
  return nav;
}

VehicleState as_state(const VehicleMotion& motion, bool on_ground) {
  VehicleState state;
  state.p_N = motion.p_N;
  state.v_N = motion.v_N;
  state.q_NB = motion.q_NB;
  state.w_NB_B = motion.w_NB_B;
  state.airspeed = motion.airspeed;
  state.on_ground = on_ground;
  return state;
}

}  // namespace skein::mixed
