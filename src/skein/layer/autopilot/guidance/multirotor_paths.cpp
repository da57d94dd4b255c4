// SPDX-License-Identifier: Apache-2.0
// MultirotorGuidance on paths, plans, routes and circles.

#include <algorithm>
#include <cmath>

#include "skein/layer/autopilot/guidance/lateral.h"
#include "skein/layer/autopilot/guidance/multirotor_guidance.h"
#include "skein/layer/autopilot/guidance/multirotor_reference.h"

namespace skein::autopilot {
namespace {

// A circle is followed from when it is this near, in radii: the path to it is no error.
constexpr double kOnCircle = 0.2;
constexpr double kTurnShare = 0.7;     // of the acceleration, for turns
constexpr double kAlongShare = 0.8;    // of the acceleration, for speeding up
constexpr double kCloseEnough = 0.05;  // of the reference to a stop [m]
constexpr double kWindow = 20;         // of paths, behind; five times as far ahead [m]

}  // namespace

// Along a path at the reference's place, with a stop ahead.
MultirotorGuidance::Setpoint MultirotorGuidance::along(
    const model::PathCursor& path, const model::PathCursor::Place& place,
    const Stop& stop, const NavState& now) {
  const Vec2 p = now.p_N.head<2>();
  const model::TrackPoint& at = place.point;
  const double back = (p - position_).dot(at.tangent);
  const model::TrackPoint beside = path.at(place.along + back);
  status_.cross_track = geo::cross(beside.tangent, p - beside.position);
  status_.along = beside.tangent;
  status_.follows = true;

  const double turns = kTurnShare * options_.acceleration;
  const double flown = velocity_.dot(at.tangent);
  // Speeding up leaves acceleration for what is across.
  const double faster =
      std::max(flown, 0.0) + kAlongShare * options_.acceleration / kVelocityGain;
  const double speed =
      path.speed_limit(place.along, turns, options_.braking * options_.acceleration,
                       std::min({stop.speed, faster, ground_speed(at.tangent, now)}));
  const Vec2 right = geo::turned_right(at.tangent);
  Setpoint setpoint;
  setpoint.altitude = altitude_;
  const double across = std::min(stop_at(std::abs(place.cross_track)).speed, speed);
  setpoint.velocity =
      speed * at.tangent - std::copysign(across, place.cross_track) * right;
  setpoint.acceleration = at.curvature * flown * flown * right;
  if (stop.speed <= speed) setpoint.acceleration -= stop.braking * at.tangent;
  return setpoint;
}

MultirotorGuidance::Setpoint MultirotorGuidance::follow_path(const NavState& now) {
  const model::PathCursor::Place place =
      path_.project(position_, along_ - kWindow, along_ + 5 * kWindow);
  along_ = place.along;
  status_.remaining = place.remaining;
  if (place.remaining < kCloseEnough) {
    arrive(path_.at(path_.length()).position);
    return towards(point_, now);
  }
  return along(path_, place, stop_at(place.remaining), now);
}

MultirotorGuidance::Setpoint MultirotorGuidance::fly_waypoints(const NavState& now) {
  const WaypointRoute::Place place = route_.project(position_, kWindow);
  const double to_stop = route_.stop_at() - place.on_path.along;
  if (place.done || (route_.on_last_leg() && to_stop < kCloseEnough)) {
    altitude_ = route_.last().altitude_msl;
    arrive(route_.last().point);
    status_.lap = route_.laps();
    return towards(point_, now);
  }
  status_.remaining = place.remaining;
  status_.lap = route_.lap();
  Stop stop = stop_at(to_stop);
  if (!route_.on_last_leg() && stop.speed < kCreep) stop = {kCreep, 0};
  double steepest = stop.speed;
  if (place.slope > 0) steepest = limits_.climb_rate / place.slope;
  if (place.slope < 0) steepest = limits_.sink_rate / -place.slope;
  if (steepest < stop.speed) stop = {steepest, 0};
  Setpoint setpoint = along(route_.cursor(), place.on_path, stop, now);
  setpoint.altitude = place.altitude_msl;
  setpoint.climb_rate = place.slope * velocity_.dot(place.on_path.point.tangent);
  return setpoint;
}

MultirotorGuidance::Setpoint MultirotorGuidance::follow_plan(const NavState& now) {
  const double time = now.time.seconds();
  if (time >= plan_.end()) {
    const Vec3 end = plan_.at(plan_.end()).p_N;
    altitude_ = -end.z();
    arrive(end.head<2>());
    return towards(point_, now);
  }
  model::PlanCurve::State at = plan_.at(std::max(time, plan_.start()));
  if (time < plan_.start()) {
    at.v_N.setZero();
    at.a_N.setZero();
  }
  const Vec2 v = at.v_N.head<2>(), leg = at.p_N.head<2>() - position_;
  const double distance = leg.norm();
  Setpoint setpoint;
  setpoint.velocity = v;
  if (distance > 1e-6) setpoint.velocity += stop_at(distance).speed / distance * leg;
  setpoint.velocity =
      bounded(setpoint.velocity, limits_.fastest + now.wind_N.head<2>().norm());
  setpoint.acceleration = bounded(at.a_N.head<2>(), options_.acceleration);
  setpoint.altitude = -at.p_N.z();
  setpoint.climb_rate = -at.v_N.z();

  const Vec2 behind = at.p_N.head<2>() - now.p_N.head<2>();
  const double speed = v.norm();
  status_.remaining = plan_.remaining(time);
  status_.follows = true;
  status_.time_error = speed > kMinPace ? behind.dot(v) / (speed * speed) : 0;
  status_.cross_track = speed > kMinPace ? geo::cross(v, -behind) / speed : 0;
  return setpoint;
}

MultirotorGuidance::Setpoint MultirotorGuidance::circle(const NavState& now) {
  const CircleLine line = CircleLine::nearest_to(position_, circle_.centre,
                                                 circle_.radius, circle_.clockwise);
  const model::TrackPoint at = line.nearest();
  const double off = line.cross_track(position_);
  const double speed =
      std::min(ground_speed(at.tangent, now),
               std::sqrt(kTurnShare * options_.acceleration * circle_.radius));
  const double across = std::min(stop_at(std::abs(off)).speed, speed);
  const double round = std::sqrt(std::max(speed * speed - across * across, 0.0));
  const Vec2 right = geo::turned_right(at.tangent);
  Setpoint setpoint;
  setpoint.altitude = altitude_;
  setpoint.velocity = round * at.tangent - std::copysign(across, off) * right;
  const double flown = velocity_.dot(at.tangent);
  const double away = (position_ - circle_.centre).norm();
  setpoint.acceleration =
      line.side * flown * flown / std::max(away, circle_.radius / 2) * right;
  const Vec2 p = now.p_N.head<2>();
  status_.cross_track = -line.side * ((p - circle_.centre).norm() - circle_.radius);
  status_.follows =
      status_.follows || std::abs(status_.cross_track) < kOnCircle * circle_.radius;
  return setpoint;
}

}  // namespace skein::autopilot
