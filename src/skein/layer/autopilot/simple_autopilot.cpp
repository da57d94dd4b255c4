// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/simple_autopilot.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"
#include "skein/layer/autopilot/guidance/same_guidance.h"
#include "skein/layer/autopilot/guidance/unflyable.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::autopilot {
namespace {

constexpr double kSlowDown = 6;  // flight before a tight turn in which to slow down [s]

FixedWingGuidanceOptions shared_options(const GuidanceOptions& own) {
  FixedWingGuidanceOptions options;
  options.lateral.law = LateralLaw::kCourse;
  options.lateral.course = {own.heading_gain, own.look_ahead};
  options.lateral.roll_lag = own.anticipation;
  options.slow_down = kSlowDown;
  options.landing.touches_down = false;
  return options;
}

// What FixedWingGuidance flies for this autopilot.
bool for_shared(const AutopilotCommand& command) {
  return std::holds_alternative<FollowPlan>(command.guidance) ||
         std::holds_alternative<FlyWaypoints>(command.guidance) ||
         std::holds_alternative<TakeOff>(command.guidance) ||
         std::holds_alternative<Land>(command.guidance) ||
         std::holds_alternative<Return>(command.guidance) ||
         std::holds_alternative<HoldBank>(command.guidance);
}

}  // namespace

SimpleAutopilot::SimpleAutopilot(const SimpleAutopilotOptions& options,
                                 const FlightLimits& limits, const NavEstimate& initial)
    : SimpleAutopilot(options, limits, initial, initial.p_N) {}

SimpleAutopilot::SimpleAutopilot(const SimpleAutopilotOptions& options,
                                 const FlightLimits& limits, const NavEstimate& initial,
                                 const Vec3& home_N)
    : options_(options),
      limits_(limits),
      roll_limit_(math::atan(limits.airspeed * limits.airspeed /
                             (kGravity * limits.turn_radius))),
      filter_(initial, options.wind_lag),
      home_N_(home_N),
      shared_(shared_options(options.guidance), limits, home_N) {
  command_.guidance = circle_around(geo::horizontal(home_N));
  command_.altitude_msl = -initial.p_N.z();
}

void SimpleAutopilot::begin(const NavEstimate& start, bool /*on_ground*/) {
  const AutopilotCommand last = std::move(command_);
  const std::optional<Vec2> place = return_;
  *this = SimpleAutopilot(options_, limits_, start, home_N_);
  return_ = place;
  command(last);
}

void SimpleAutopilot::sense(const SensorSample& sample) {
  if (const auto* fix = std::get_if<GnssFix>(&sample)) filter_.add(*fix);
  if (const auto* air = std::get_if<AirDataSample>(&sample)) filter_.add(*air);
}

void SimpleAutopilot::set_return(const ReturnRoute& route) {
  const auto* back = std::get_if<Return>(&command_.guidance);
  const bool takes_off = is_shared_ && back && back->point == return_;
  return_ = route.points.empty() ? std::nullopt : std::optional(route.points.back());
  if (takes_off) command({Return{}, command_.altitude_msl, command_.airspeed});
}

void SimpleAutopilot::command(const AutopilotCommand& command) {
  if (const auto* back = std::get_if<Return>(&command.guidance);
      back && !back->point && return_) {
    this->command({Return{return_}, command.altitude_msl, command.airspeed});
    return;
  }
  if (auto reason = not_finite(command)) return refuse(std::move(*reason));
  if (for_shared(command)) {
    // Judged by the mean wind, not by what is felt just now.
    const FixedWingMotion at = motion(estimate().wind_N);
    // While it did not fly, it may hold an old command that is not to be gone on with.
    if (!is_shared_) shared_.forget(at);
    if (auto reason = shared_.command(command, at)) return refuse(std::move(*reason));
    is_shared_ = true;
    command_ = command;
    begin_status(shared_.status());
    return;
  }
  const bool goes_on = !is_shared_ && same_guidance(command_, command);
  is_shared_ = false;
  command_ = command;
  if (goes_on) return;
  begin_status({});
  along_ = 0;
  hold_circle_ = circle_around(geo::horizontal(home_N_));
  if (const auto* hold = std::get_if<HoldPosition>(&command_.guidance))
    hold_circle_ = circle_around(hold->point);
  const auto* next = std::get_if<FollowPath>(&command_.guidance);
  if (!next) return;
  path_.assign(next->path);
  status_.remaining = path_.length();
  status_.done = path_.empty();
  if (status_.done) end_circle_ = circle_around(geo::horizontal(estimate().p_N));
}

void SimpleAutopilot::refuse(std::string reason) {
  refused_ = std::move(reason);
  status_.refused = refused_;
  ++status_.refusals;
}

// What was refused so far stays in the status.
void SimpleAutopilot::begin_status(AutopilotStatus status) {
  status.refusals = status_.refusals;
  status.refused = status_.refused;
  status_ = status;
}

FixedWingMotion SimpleAutopilot::motion(const Vec2& wind) const {
  const NavEstimate& nav = filter_.estimate();
  const Vec2 v = nav.v_N.head<2>(), air = v - wind;
  const double both = std::sqrt(v.squaredNorm() * air.squaredNorm());
  const double drift = both > 1e-6 ? v.dot(air) / both : 1;
  return {nav.time,
          nav.p_N,
          nav.v_N,
          wind,
          filter_.airspeed(),
          filter_.airspeed() * filter_.turn_rate() * std::max(drift, 0.0),
          {}};
}

double SimpleAutopilot::climb_rate(double altitude_msl, double rate) const {
  const double setpoint =
      options_.altitude_gain * (altitude_msl + filter_.estimate().p_N.z()) + rate;
  return std::clamp(setpoint, -limits_.climb_rate, limits_.climb_rate);
}

Control SimpleAutopilot::control(Time now, double dt) {
  filter_.advance(now);
  if (is_shared_) return fly_shared(dt);
  const NavEstimate& nav = filter_.estimate();
  const Motion motion{geo::horizontal(nav.p_N), nav.heading, filter_.airspeed(),
                      filter_.drift()};
  const double turn_rate = turn_rate_for(demand(motion), motion, options_.guidance);

  FlightCommand out;
  out.roll = std::clamp(math::atan(turn_rate * motion.airspeed / kGravity), -roll_limit_,
                        roll_limit_);
  out.airspeed = airspeed_for_turns();
  out.climb_rate = climb_rate(command_.altitude_msl, 0);
  return out;
}

FlightCommand SimpleAutopilot::fly_shared(double dt) {
  const FixedWingMotion at = motion(filter_.drift());
  const FixedWingDemand setpoint = shared_.step(at, dt);
  begin_status(shared_.status());
  const Vec2 v = at.v_N.head<2>(), air = v - at.wind;
  const double both = std::sqrt(v.squaredNorm() * air.squaredNorm());
  // Where the wind carries it aside or back, the bank that is left does what it can.
  const double drift = both > 1e-6 ? std::max(v.dot(air) / both, 0.3) : 1;
  FlightCommand out;
  out.roll = std::clamp(math::atan(setpoint.lateral_acceleration / (kGravity * drift)),
                        -roll_limit_, roll_limit_);
  out.airspeed = setpoint.airspeed;
  out.climb_rate = climb_rate(setpoint.altitude_msl, setpoint.climb_rate);
  return out;
}

CourseDemand SimpleAutopilot::demand(const Motion& motion) {
  const double ground_speed =
      std::max(geo::horizontal(filter_.estimate().v_N).norm(), 0.2 * limits_.airspeed);
  if (const auto* hold = std::get_if<HoldCourse>(&command_.guidance))
    return {hold->course, 0};
  if (const auto* around = std::get_if<Circle>(&command_.guidance))
    return circle(*around, motion.position, ground_speed, options_.guidance);
  if (std::holds_alternative<FollowPath>(command_.guidance))
    return follow(motion, ground_speed);
  return circle(hold_circle_, motion.position, ground_speed, options_.guidance);
}

CourseDemand SimpleAutopilot::follow(const Motion& motion, double ground_speed) {
  if (status_.done)
    return circle(end_circle_, motion.position, ground_speed, options_.guidance);
  // Only the near part of the path counts, so that it may cross itself.
  const double window = 5 * options_.guidance.look_ahead * ground_speed;
  const model::PathCursor::Place at =
      path_.project(motion.position, along_ - window / 5, along_ + window);
  along_ = at.along;
  status_.remaining = at.remaining;
  status_.cross_track = at.cross_track;
  status_.follows = true;

  const Vec2 beyond = motion.position - at.point.position;
  if (at.remaining <= 0 && beyond.dot(at.point.tangent) >= 0) {
    begin_status({});
    status_.done = true;
    end_circle_ = circle_around(at.point.position);
    return circle(end_circle_, motion.position, ground_speed, options_.guidance);
  }
  const double ahead = along_ + ground_speed * options_.guidance.anticipation;
  return track(at.course, path_.curvature_at(ahead), at.cross_track, ground_speed,
               options_.guidance);
}

Circle SimpleAutopilot::circle_around(const Vec2& centre) const {
  // A tenth wider than the wind demands, so that corrections have room.
  const double wind = filter_.estimate().wind_N.norm();
  return {centre,
          1.1 * model::ground_turn_radius(limits_.turn_radius, limits_.airspeed, wind),
          true};
}

double SimpleAutopilot::airspeed_for_turns() const {
  const double base = std::clamp(command_.airspeed.value_or(limits_.airspeed),
                                 limits_.slowest, limits_.fastest);
  double tightest = 0;
  if (std::holds_alternative<FollowPath>(command_.guidance)) {
    if (status_.done) return base;  // the end's circle is wide enough
    const double reach = along_ + kSlowDown * geo::horizontal(estimate().v_N).norm();
    tightest = path_.tightest(along_, reach);
  } else if (const auto* around = std::get_if<Circle>(&command_.guidance)) {
    tightest = 1 / around->radius;
  }
  if (tightest == 0) return base;
  const double ground_speed = std::sqrt(kGravity * math::tan(roll_limit_) / tightest);
  const double min = std::min(options_.slowest * limits_.airspeed, base);
  return std::clamp(ground_speed - filter_.drift().norm(), min, base);
}

}  // namespace skein::autopilot
