// SPDX-License-Identifier: Apache-2.0
// MultirotorGuidance: how the reference moves.

#include <algorithm>
#include <cmath>

#include "skein/layer/autopilot/guidance/multirotor_guidance.h"
#include "skein/layer/autopilot/guidance/multirotor_reference.h"

namespace skein::autopilot {
namespace {

constexpr double kYawSpeed = 1;  // slower than this has no course [m/s]

}  // namespace

void MultirotorGuidance::reset(const NavState& now) {
  position_ = now.p_N.head<2>();
  velocity_ = bounded(now.v_N.head<2>(), limits_.fastest + now.wind_N.head<2>().norm());
  acceleration_.setZero();
  altitude_ref_ = -now.p_N.z();
  climb_ref_ = std::clamp(-now.v_N.z(), -limits_.sink_rate, limits_.climb_rate);
}

void MultirotorGuidance::move(const Setpoint& setpoint, const NavState& now, double dt) {
  const Vec2 p = now.p_N.head<2>();
  const double lag = (position_ - p).norm();
  const double wait = std::clamp(2 - lag / options_.max_lag, 0.0, 1.0);
  const Vec2 demanded = bounded(
      setpoint.acceleration + kVelocityGain * (wait * setpoint.velocity - velocity_),
      options_.acceleration);
  acceleration_ += bounded(demanded - acceleration_, options_.jerk * dt);
  position_ += dt * (velocity_ + dt / 2 * acceleration_);
  velocity_ += dt * acceleration_;
  // Where only the velocity counts the position goes along.
  if (doing_ == Doing::kCourse) position_ = p;

  const double off = setpoint.altitude - altitude_ref_;
  const double b = options_.braking * options_.climb_acceleration, k = options_.stop_gain;
  const double far = std::abs(off), linear = b / (k * k);
  const double back = far < linear ? k * far : std::sqrt(2 * b * (far - linear / 2));
  const double rate = std::clamp(setpoint.climb_rate + std::copysign(back, off),
                                 -limits_.sink_rate, limits_.climb_rate);
  climb_ref_ += std::clamp(rate - climb_ref_, -options_.climb_acceleration * dt,
                           options_.climb_acceleration * dt);
  altitude_ref_ += dt * climb_ref_;
}

void MultirotorGuidance::turn(double dt) {
  if (!options_.yaws_along_track || velocity_.squaredNorm() < kYawSpeed * kYawSpeed)
    return;
  const double off = geo::wrap_pi(geo::bearing(velocity_) - heading_);
  heading_ = geo::wrap_pi(
      heading_ + std::clamp(off, -options_.yaw_rate * dt, options_.yaw_rate * dt));
}

double MultirotorGuidance::ground_speed(const Vec2& course, const NavState& now) const {
  const Vec2 wind = now.wind_N.head<2>();
  const double across = geo::cross(course, wind), with = wind.dot(course);
  const auto over_ground = [&](double airspeed) {
    return std::sqrt(std::max(airspeed * airspeed - across * across, 0.0)) + with;
  };
  const double speed = over_ground(command_.airspeed.value_or(limits_.airspeed));
  if (speed >= kMinPace) return speed;
  return std::clamp(over_ground(limits_.fastest), 0.0, kMinPace);
}

MultirotorGuidance::Stop MultirotorGuidance::stop_at(double distance) const {
  const double b = options_.braking * options_.acceleration, k = options_.stop_gain;
  const double linear = b / (k * k);
  if (distance >= linear) return {std::sqrt(2 * b * (distance - linear / 2)), b};
  const double speed = k * std::max(distance, 0.0);
  return {speed, k * speed};
}

MultirotorGuidance::Setpoint MultirotorGuidance::towards(const Vec2& point,
                                                         const NavState& now) const {
  Setpoint setpoint;
  setpoint.altitude = altitude_;
  const Vec2 leg = point - position_;
  const double distance = leg.norm();
  if (distance < 1e-6) return setpoint;
  const Vec2 course = leg / distance;
  const Stop stop = stop_at(distance);
  const double max = ground_speed(course, now);
  setpoint.velocity = std::min(stop.speed, max) * course;
  if (stop.speed <= max) setpoint.acceleration = -stop.braking * course;
  return setpoint;
}

}  // namespace skein::autopilot
