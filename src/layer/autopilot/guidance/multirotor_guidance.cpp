#include "layer/autopilot/guidance/multirotor_guidance.h"

#include <algorithm>
#include <cmath>

#include "layer/autopilot/guidance/lateral.h"
#include "layer/autopilot/guidance/same_guidance.h"
#include "layer/autopilot/guidance/unflyable.h"

namespace skein::autopilot {
namespace {

// A circle is followed from when it is this near, in radii: the way to it is no error.
constexpr double kOnCircle = 0.2;

constexpr double kVelocityGain = 4;    // of the reference [1/s]
constexpr double kTurnShare = 0.7;     // of the acceleration, for turns
constexpr double kAlongShare = 0.8;    // of the acceleration, for speeding up
constexpr double kCreep = 0.2;         // through sharp corners [m/s]
constexpr double kLeastSpeed = 1;      // over ground, against the wind [m/s]
constexpr double kYawSpeed = 1;        // slower than this has no course [m/s]
constexpr double kCloseEnough = 0.05;  // of the reference to a stop [m]
constexpr double kStillSink = 0.15;    // slower than this does not sink [m/s]
constexpr double kStillTime = 1;       // for this long: on the ground [s]
constexpr double kPushed = 0.3;        // the reference this deep in the ground [m]
constexpr double kDeepest = 1;         // and no deeper [m]
constexpr double kWindow = 20;         // of paths, behind; five times as far ahead [m]

FlightLimits limits_of(const MultirotorAirframe& a) {
  FlightLimits limits;
  limits.airspeed = a.cruise;
  limits.turn_radius = 1;  // turns on the spot: nothing asks for it
  limits.climb_rate = a.climb_rate;
  limits.slowest = 0;
  limits.fastest = a.fastest;
  limits.sink_rate = a.sink_rate;
  return limits;
}

Vec2 bounded(const Vec2& v, double most) {
  const double size = v.norm();
  return size > most ? Vec2(v * (most / size)) : v;
}

}  // namespace

MultirotorGuidance::MultirotorGuidance(const MultirotorGuidanceOptions& options,
                                       const MultirotorAirframe& airframe,
                                       const Vec3& home_N)
    : options_(options), limits_(limits_of(airframe)), home_N_(home_N) {
  command_.guidance = HoldPosition{geo::horizontal(home_N)};
}

void MultirotorGuidance::reset(const NavState& now) {
  position_ = now.p_N.head<2>();
  velocity_ = bounded(now.v_N.head<2>(), limits_.fastest + now.wind_N.head<2>().norm());
  acceleration_.setZero();
  altitude_ref_ = -now.p_N.z();
  climb_ref_ = std::clamp(-now.v_N.z(), -limits_.sink_rate, limits_.climb_rate);
}

std::optional<std::string> MultirotorGuidance::command(const AutopilotCommand& command,
                                                       const NavState& now) {
  const bool goes_on = same_guidance(command_, command);
  const AutopilotCommand asked =
      goes_on ? AutopilotCommand{HoldPosition{}, command.altitude_msl, command.airspeed}
              : command;
  if (auto reason = unflyable(asked, limits_, now.wind_N.head<2>())) return reason;
  if (goes_on) {
    command_.altitude_msl = command.altitude_msl;
    command_.airspeed = command.airspeed;
    if (!has_own_altitude(command_)) altitude_ = command.altitude_msl;
  } else {
    begin(command, now);
  }
  return {};
}

void MultirotorGuidance::forget(const NavState& now) {
  started_ = false;
  begin({HoldPosition{now.p_N.head<2>()}, -now.p_N.z(), {}}, now);
  // Where (7) of docs/guidance.md comes to a stand from this speed.
  const double b = options_.braking * options_.acceleration, k = options_.stop_gain;
  const double speed = velocity_.norm();
  const double way =
      speed < b / k ? speed / k : speed * speed / (2 * b) + b / (2 * k * k);
  if (speed > 0) point_ += way / speed * velocity_;
  command_.guidance = HoldPosition{point_};
}

void MultirotorGuidance::begin(const AutopilotCommand& command, const NavState& now) {
  if (!started_) heading_ = geo::yaw(now.q_NB);
  // A reference that the vehicle follows goes on; one it has lost begins anew.
  if (!started_ || (position_ - now.p_N.head<2>()).norm() > options_.most_lag ||
      phase_ == FlightPhase::kGround)
    reset(now);
  started_ = true;
  command_ = command;
  status_ = {};
  phase_ = FlightPhase::kFlight;
  altitude_ = command.altitude_msl;
  along_ = 0;
  still_for_ = 0;
  climbs_first_ = false;
  point_ = now.p_N.head<2>();
  if (const auto* f = std::get_if<FollowPath>(&command_.guidance)) {
    path_.assign(f->path);
    doing_ = Doing::kPath;
    status_.remaining = path_.length();
    if (path_.empty()) arrive(point_);
  } else if (const auto* h = std::get_if<HoldCourse>(&command_.guidance)) {
    course_ = geo::unit(h->course);
    doing_ = Doing::kCourse;
  } else if (const auto* c = std::get_if<Circle>(&command_.guidance)) {
    circle_ = *c;
    doing_ = Doing::kCircle;
  } else if (const auto* at = std::get_if<HoldPosition>(&command_.guidance)) {
    point_ = at->point;
    doing_ = Doing::kHold;
  } else if (const auto* plan = std::get_if<FollowPlan>(&command_.guidance)) {
    plan_.assign(plan->plan);
    doing_ = Doing::kPlan;
  } else if (const auto* w = std::get_if<FlyWaypoints>(&command_.guidance)) {
    route_.begin(*w, {position_.x(), position_.y(), -altitude_ref_},
                 {0, options_.corner_cut});
    doing_ = Doing::kWaypoints;
  } else if (std::holds_alternative<TakeOff>(command_.guidance)) {
    reset(now);
    doing_ = Doing::kTakeOff;
    phase_ = FlightPhase::kClimbOut;
  } else if (const auto* l = std::get_if<Land>(&command_.guidance)) {
    point_ = l->point;
    altitude_ = std::max(altitude_ref_, l->ground_msl + options_.slow_height);
    doing_ = Doing::kLand;
  } else {
    altitude_ = std::max(altitude_, options_.return_height - home_N_.z());
    doing_ = Doing::kHold;
    climbs_first_ = true;
  }
}

void MultirotorGuidance::arrive(const Vec2& at) {
  status_ = {};
  status_.done = true;
  point_ = at;
  doing_ = Doing::kHold;
}

MultirotorDemand MultirotorGuidance::step(const NavState& now, double dt,
                                          std::optional<double> height_agl) {
  if (!started_) {
    started_ = true;
    reset(now);
    heading_ = geo::yaw(now.q_NB);
    point_ = position_;
    altitude_ = altitude_ref_;
  }
  Wish wish;
  switch (doing_) {
    case Doing::kHold:
      wish = hold(now);
      break;
    case Doing::kCourse:
      wish = hold_course(now);
      break;
    case Doing::kPath:
      wish = follow_path(now);
      break;
    case Doing::kPlan:
      wish = follow_plan(now);
      break;
    case Doing::kWaypoints:
      wish = fly_waypoints(now);
      break;
    case Doing::kCircle:
      wish = circle(now);
      break;
    case Doing::kTakeOff:
      wish = take_off(now);
      break;
    case Doing::kLand:
      wish = land(now, dt, height_agl);
      break;
  }
  move(wish, now, dt);
  turn(dt);
  MultirotorDemand demand;
  demand.position = position_;
  demand.velocity = velocity_;
  demand.acceleration = acceleration_;
  demand.holds_position = doing_ != Doing::kCourse;
  demand.altitude_msl = altitude_ref_;
  demand.climb_rate = climb_ref_;
  demand.heading = heading_;
  demand.phase = phase_;
  return demand;
}

void MultirotorGuidance::move(const Wish& wish, const NavState& now, double dt) {
  const Vec2 p = now.p_N.head<2>();
  const double lag = (position_ - p).norm();
  const double wait = std::clamp(2 - lag / options_.most_lag, 0.0, 1.0);
  const Vec2 wanted =
      bounded(wish.acceleration + kVelocityGain * (wait * wish.velocity - velocity_),
              options_.acceleration);
  acceleration_ += bounded(wanted - acceleration_, options_.jerk * dt);
  position_ += dt * (velocity_ + dt / 2 * acceleration_);
  velocity_ += dt * acceleration_;
  // Where only the velocity counts the position goes along.
  if (doing_ == Doing::kCourse) position_ = p;

  const double off = wish.altitude - altitude_ref_;
  const double b = options_.braking * options_.climb_acceleration, k = options_.stop_gain;
  const double far = std::abs(off), linear = b / (k * k);
  const double back = far < linear ? k * far : std::sqrt(2 * b * (far - linear / 2));
  const double rate = std::clamp(wish.climb_rate + std::copysign(back, off),
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
  if (speed >= kLeastSpeed) return speed;
  return std::clamp(over_ground(limits_.fastest), 0.0, kLeastSpeed);
}

MultirotorGuidance::Stop MultirotorGuidance::stop_at(double distance) const {
  const double b = options_.braking * options_.acceleration, k = options_.stop_gain;
  const double linear = b / (k * k);
  if (distance >= linear) return {std::sqrt(2 * b * (distance - linear / 2)), b};
  const double speed = k * std::max(distance, 0.0);
  return {speed, k * speed};
}

MultirotorGuidance::Wish MultirotorGuidance::towards(const Vec2& point,
                                                     const NavState& now) const {
  Wish wish;
  wish.altitude = altitude_;
  const Vec2 way = point - position_;
  const double distance = way.norm();
  if (distance < 1e-6) return wish;
  const Vec2 course = way / distance;
  const Stop stop = stop_at(distance);
  const double most = ground_speed(course, now);
  wish.velocity = std::min(stop.speed, most) * course;
  if (stop.speed <= most) wish.acceleration = -stop.braking * course;
  return wish;
}

MultirotorGuidance::Wish MultirotorGuidance::hold(const NavState& now) {
  const bool returns = std::holds_alternative<Return>(command_.guidance);
  if (returns) {
    // Up first, so that nothing is in the way.
    climbs_first_ = climbs_first_ && -now.p_N.z() < altitude_ - options_.arrival;
    if (!climbs_first_) point_ = home_N_.head<2>();
  }
  if (returns || std::holds_alternative<HoldPosition>(command_.guidance)) {
    status_.remaining = (point_ - now.p_N.head<2>()).norm();
    status_.done =
        status_.done || (!climbs_first_ && status_.remaining <= options_.arrival);
  }
  return towards(point_, now);
}

MultirotorGuidance::Wish MultirotorGuidance::hold_course(const NavState& now) {
  Wish wish;
  wish.altitude = altitude_;
  wish.velocity = ground_speed(course_, now) * course_;
  return wish;
}

// Along a path at the reference's place, with a stop ahead.
MultirotorGuidance::Wish MultirotorGuidance::along(const model::PathCursor& path,
                                                   const model::PathCursor::Place& place,
                                                   const Stop& stop,
                                                   const NavState& now) {
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
  Wish wish;
  wish.altitude = altitude_;
  const double across = std::min(stop_at(std::abs(place.cross_track)).speed, speed);
  wish.velocity = speed * at.tangent - std::copysign(across, place.cross_track) * right;
  wish.acceleration = at.curvature * flown * flown * right;
  if (stop.speed <= speed) wish.acceleration -= stop.braking * at.tangent;
  return wish;
}

MultirotorGuidance::Wish MultirotorGuidance::follow_path(const NavState& now) {
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

MultirotorGuidance::Wish MultirotorGuidance::fly_waypoints(const NavState& now) {
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
  Wish wish = along(route_.cursor(), place.on_path, stop, now);
  wish.altitude = place.altitude_msl;
  wish.climb_rate = place.slope * velocity_.dot(place.on_path.point.tangent);
  return wish;
}

MultirotorGuidance::Wish MultirotorGuidance::follow_plan(const NavState& now) {
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
  const Vec2 v = at.v_N.head<2>(), way = at.p_N.head<2>() - position_;
  const double distance = way.norm();
  Wish wish;
  wish.velocity = v;
  if (distance > 1e-6) wish.velocity += stop_at(distance).speed / distance * way;
  wish.velocity = bounded(wish.velocity, limits_.fastest + now.wind_N.head<2>().norm());
  wish.acceleration = bounded(at.a_N.head<2>(), options_.acceleration);
  wish.altitude = -at.p_N.z();
  wish.climb_rate = -at.v_N.z();

  const Vec2 behind = at.p_N.head<2>() - now.p_N.head<2>();
  const double speed = v.norm();
  status_.remaining = plan_.remaining(time);
  status_.follows = true;
  status_.time_error = speed > kLeastSpeed ? behind.dot(v) / (speed * speed) : 0;
  status_.cross_track = speed > kLeastSpeed ? geo::cross(v, -behind) / speed : 0;
  return wish;
}

MultirotorGuidance::Wish MultirotorGuidance::circle(const NavState& now) {
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
  Wish wish;
  wish.altitude = altitude_;
  wish.velocity = round * at.tangent - std::copysign(across, off) * right;
  const double flown = velocity_.dot(at.tangent);
  const double away = (position_ - circle_.centre).norm();
  wish.acceleration =
      line.side * flown * flown / std::max(away, circle_.radius / 2) * right;
  const Vec2 p = now.p_N.head<2>();
  status_.cross_track = -line.side * ((p - circle_.centre).norm() - circle_.radius);
  status_.follows =
      status_.follows || std::abs(status_.cross_track) < kOnCircle * circle_.radius;
  return wish;
}

MultirotorGuidance::Wish MultirotorGuidance::take_off(const NavState& now) {
  status_.remaining = std::max(altitude_ + now.p_N.z(), 0.0);
  status_.done = status_.done || status_.remaining <= options_.arrival;
  phase_ = status_.done ? FlightPhase::kFlight : FlightPhase::kClimbOut;
  return towards(point_, now);
}

MultirotorGuidance::Wish MultirotorGuidance::land(const NavState& now, double dt,
                                                  std::optional<double> height_agl) {
  const Land& land = std::get<Land>(command_.guidance);
  const double height = height_agl.value_or(-now.p_N.z() - land.ground_msl);
  Wish wish = towards(point_, now);
  status_.remaining = (point_ - now.p_N.head<2>()).norm();
  if (phase_ == FlightPhase::kFlight && status_.remaining <= options_.arrival &&
      velocity_.norm() < kCreep)
    phase_ = FlightPhase::kApproach;
  if (phase_ == FlightPhase::kFlight) return wish;
  if (phase_ == FlightPhase::kApproach && height <= options_.slow_height)
    phase_ = FlightPhase::kFlare;

  // The reference sinks by its rate: braked before slow_height, then slowly until the
  // ground holds the vehicle up.
  const double b = options_.braking * options_.climb_acceleration;
  const double above = std::max(height - options_.slow_height, 0.0);
  const double sink =
      std::min(options_.touch_down_sink + std::sqrt(2 * b * above), limits_.sink_rate);
  wish.altitude = altitude_ref_;
  wish.climb_rate = -sink;
  const bool pushed = altitude_ref_ < -now.p_N.z() - kPushed;
  still_for_ = pushed && std::abs(now.v_N.z()) < kStillSink ? still_for_ + dt : 0;
  if (altitude_ref_ < -now.p_N.z() - kDeepest) wish.climb_rate = 0;
  if (still_for_ >= kStillTime) phase_ = FlightPhase::kGround;
  if (phase_ == FlightPhase::kGround) {
    status_.done = true;
    wish.velocity.setZero();
    wish.climb_rate = 0;
  }
  return wish;
}

}  // namespace skein::autopilot
