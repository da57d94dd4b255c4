// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/guidance/multirotor_guidance.h"

#include <algorithm>
#include <cmath>

#include "skein/layer/autopilot/guidance/multirotor_reference.h"
#include "skein/layer/autopilot/guidance/same_guidance.h"
#include "skein/layer/autopilot/guidance/unflyable.h"

namespace skein::autopilot {
namespace {

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

}  // namespace

MultirotorGuidance::MultirotorGuidance(const MultirotorGuidanceOptions& options,
                                       const MultirotorAirframe& airframe,
                                       const Vec3& home_N)
    : options_(options), limits_(limits_of(airframe)), home_N_(home_N) {
  command_.guidance = HoldPosition{geo::horizontal(home_N)};
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
  const double travelled =
      speed < b / k ? speed / k : speed * speed / (2 * b) + b / (2 * k * k);
  if (speed > 0) point_ += travelled / speed * velocity_;
  command_.guidance = HoldPosition{point_};
}

void MultirotorGuidance::begin(const AutopilotCommand& command, const NavState& now) {
  if (!started_) heading_ = geo::yaw(now.q_NB);
  // A reference that the vehicle follows goes on; one it has lost begins anew.
  if (!started_ || (position_ - now.p_N.head<2>()).norm() > options_.max_lag ||
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
  Setpoint setpoint;
  switch (doing_) {
    case Doing::kHold:
      setpoint = hold(now);
      break;
    case Doing::kCourse:
      setpoint = hold_course(now);
      break;
    case Doing::kPath:
      setpoint = follow_path(now);
      break;
    case Doing::kPlan:
      setpoint = follow_plan(now);
      break;
    case Doing::kWaypoints:
      setpoint = fly_waypoints(now);
      break;
    case Doing::kCircle:
      setpoint = circle(now);
      break;
    case Doing::kTakeOff:
      setpoint = take_off(now);
      break;
    case Doing::kLand:
      setpoint = land(now, dt, height_agl);
      break;
  }
  move(setpoint, now, dt);
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

MultirotorGuidance::Setpoint MultirotorGuidance::hold(const NavState& now) {
  const auto* returns = std::get_if<Return>(&command_.guidance);
  if (returns) {
    // Up first, clear of obstacles.
    climbs_first_ = climbs_first_ && -now.p_N.z() < altitude_ - options_.arrival;
    if (!climbs_first_) point_ = returns->point.value_or(home_N_.head<2>());
  }
  if (returns || std::holds_alternative<HoldPosition>(command_.guidance)) {
    status_.remaining = (point_ - now.p_N.head<2>()).norm();
    status_.done =
        status_.done || (!climbs_first_ && status_.remaining <= options_.arrival);
  }
  return towards(point_, now);
}

MultirotorGuidance::Setpoint MultirotorGuidance::hold_course(const NavState& now) {
  Setpoint setpoint;
  setpoint.altitude = altitude_;
  setpoint.velocity = ground_speed(course_, now) * course_;
  return setpoint;
}

}  // namespace skein::autopilot
