// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/traffic/piloted_motion.h"

#include <algorithm>

namespace skein::environment {
namespace {

constexpr double kLevelOff = 4;  // time constant of reaching an altitude [s]

double towards(double from, double to, double at_most) {
  return from + std::clamp(to - from, -at_most, at_most);
}

}  // namespace

void PilotedMotion::step(const PilotedSetpoint& setpoint, const PilotedLimits& limits,
                         double dt) {
  const double turn = std::clamp(geo::wrap_pi(setpoint.course - course_),
                                 -limits.turn_rate * dt, limits.turn_rate * dt);
  const double course = course_ + turn / 2;  // in the middle of the step
  course_ = geo::wrap_pi(course_ + turn);
  speed_ = towards(speed_, setpoint.speed, limits.acceleration * dt);
  climb_ =
      std::clamp((setpoint.altitude + p_N_.z()) / kLevelOff, -limits.climb, limits.climb);
  const Vec2 ahead = geo::unit(course);
  p_N_ += dt * Vec3(speed_ * ahead.x(), speed_ * ahead.y(), -climb_);
}

Vec3 PilotedMotion::v_N() const {
  const Vec2 ahead = geo::unit(course_);
  return {speed_ * ahead.x(), speed_ * ahead.y(), -climb_};
}

}  // namespace skein::environment
