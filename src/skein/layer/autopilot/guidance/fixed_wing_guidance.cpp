// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/guidance/fixed_wing_guidance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"
#include "skein/layer/autopilot/guidance/same_guidance.h"
#include "skein/layer/autopilot/guidance/steering.h"
#include "skein/layer/autopilot/guidance/unflyable.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::autopilot {
namespace {

// A circle is followed from when it is this near, in radii: the path to it is no error.
constexpr double kOnCircle = 0.2;

constexpr double kFarOff = 2;         // look-aheads from which a circle is far away
constexpr double kSearch = 60;        // of a plan, before and after now, at the start [s]
constexpr double kMaxBank = 1.4;      // that is commanded; the limit is less [rad]
constexpr double kTurnReserve = 0.9;  // of the bank limit; the rest is for corrections

Sight sight_of(const LateralOptions& options) {
  return options.law == LateralLaw::kL1 ? l1_sight(options.l1)
                                        : l2_plus_sight(options.l2);
}

struct PathAhead {
  const model::PathCursor& path;
  double along;
  model::TrackPoint at(double ahead) const { return path.at(along + ahead); }
};

}  // namespace

FixedWingMotion motion_of(const NavState& nav, std::optional<double> height_agl) {
  FixedWingMotion out{nav.time,     nav.p_N, nav.v_N,   geo::horizontal(nav.wind_N),
                      nav.airspeed, 0,       height_agl};
  const Vec3 down = geo::down_in_body(nav.q_NB);
  const Vec2 v = geo::horizontal(nav.v_N);
  const Vec2 air = v - out.wind;
  const double both = std::sqrt(v.squaredNorm() * air.squaredNorm());
  // Beyond 70 degrees of bank the estimate is of no use here.
  const double tangent = down.y() / std::max(down.z(), 0.3);
  if (both > 1e-6)
    out.lateral_acceleration = kGravity * tangent * std::max(v.dot(air) / both, 0.0);
  return out;
}

FixedWingGuidance::FixedWingGuidance(const FixedWingGuidanceOptions& options,
                                     const FlightLimits& limits, const Vec3& home_N)
    : options_(options),
      limits_(limits),
      home_N_(home_N),
      sight_(sight_of(options.lateral)),
      max_lateral_(limits.airspeed * limits.airspeed / limits.turn_radius) {
  // In a turn the lift is g / cos(bank): the slowest airspeed grows with its root.
  const double load = std::sqrt(1 + math::squared(max_lateral_ / kGravity));
  turn_slowest_ = std::min(limits.slowest * std::sqrt(load), limits.airspeed);
  command_.guidance = HoldPosition{geo::horizontal(home_N)};
  command_.altitude_msl = altitude_ = -home_N.z();
  hold_ = {geo::horizontal(home_N), loiter_radius(0), true};
}

double FixedWingGuidance::loiter_radius(double wind_speed) const {
  return options_.radius_margin *
         model::ground_turn_radius(limits_.turn_radius, limits_.airspeed, wind_speed);
}

double FixedWingGuidance::base_airspeed() const {
  return std::clamp(command_.airspeed.value_or(limits_.airspeed), limits_.slowest,
                    limits_.fastest);
}

// Limits for `unflyable`; without any, only what is malformed is left to refuse.
FlightLimits FixedWingGuidance::judged_by() const {
  if (options_.refuses) return limits_;
  FlightLimits none = limits_;
  none.slowest = 0;
  none.fastest = none.climb_rate = none.sink_rate = std::numeric_limits<double>::max();
  none.min_density = 0;
  return none;
}

double FixedWingGuidance::airspeed_for(double curvature, double wind_speed) const {
  const double base = base_airspeed();
  if (curvature <= 0) return base;
  const double ground_speed = std::sqrt(kTurnReserve * max_lateral_ / curvature);
  return std::min(base, std::max(ground_speed - wind_speed, turn_slowest_));
}

std::optional<std::string> FixedWingGuidance::command(const AutopilotCommand& command,
                                                      const FixedWingMotion& now) {
  if (same_guidance(command_, command)) {
    if (auto reason = unflyable({HoldPosition{}, command.altitude_msl, command.airspeed},
                                judged_by(), now.wind))
      return reason;
    command_.altitude_msl = command.altitude_msl;
    command_.airspeed = command.airspeed;
    if (!has_own_altitude(command_)) altitude_ = command.altitude_msl;
    return {};
  }
  if (auto reason = unflyable(command, judged_by(), now.wind)) return reason;
  begin(command, now);
  return {};
}

void FixedWingGuidance::change(const LateralOptions& lateral) {
  options_.lateral = lateral;
  sight_ = sight_of(lateral);
}

void FixedWingGuidance::forget(const FixedWingMotion& now) {
  begin({HoldPosition{now.p_N.head<2>()}, -now.p_N.z(), {}}, now);
}

void FixedWingGuidance::hold_at(const Vec2& centre, const FixedWingMotion& now) {
  hold_ = {centre, loiter_radius(now.wind.norm()), true};
  min_hold_ = 0;
  doing_ = Doing::kCircle;
}

void FixedWingGuidance::begin(const AutopilotCommand& command,
                              const FixedWingMotion& now) {
  command_ = command;
  status_ = {};
  altitude_ = command.altitude_msl;
  phase_ = FlightPhase::kFlight;
  along_ = 0;
  const Vec2 p = now.p_N.head<2>();
  const Vec2 v = now.v_N.head<2>();
  if (const auto* f = std::get_if<FollowPath>(&command_.guidance)) {
    path_.assign(f->path);
    doing_ = Doing::kPath;
    status_.remaining = path_.length();
    if (path_.empty()) arrive(p, now);
  } else if (const auto* h = std::get_if<HoldCourse>(&command_.guidance)) {
    course_ = geo::unit(h->course);
    doing_ = Doing::kCourse;
  } else if (const auto* b = std::get_if<HoldBank>(&command_.guidance)) {
    bank_ = b->roll;
    doing_ = Doing::kBank;
  } else if (const auto* c = std::get_if<Circle>(&command_.guidance)) {
    hold_ = *c;
    min_hold_ = c->radius;
    doing_ = Doing::kCircle;
  } else if (const auto* at = std::get_if<HoldPosition>(&command_.guidance)) {
    hold_at(at->point, now);
  } else if (const auto* plan = std::get_if<FollowPlan>(&command_.guidance)) {
    plan_.assign(plan->plan);
    const double time = std::clamp(now.time.seconds(), plan_.start(), plan_.end());
    plan_time_ = plan_.nearest(p, std::max(time - kSearch, plan_.start()),
                               std::min(time + kSearch, plan_.end()), 1);
    doing_ = Doing::kPlan;
    status_.remaining = plan_.remaining(plan_time_);
  } else if (const auto* w = std::get_if<FlyWaypoints>(&command_.guidance)) {
    const double radius = options_.rounds_corners ? loiter_radius(now.wind.norm()) : 0;
    route_.begin(*w, now.p_N, {radius, 0});
    doing_ = Doing::kWaypoints;
  } else if (const auto* t = std::get_if<TakeOff>(&command_.guidance)) {
    course_ = geo::unit(t->course);
    run_start_ = p;
    run_altitude_ = -now.p_N.z();
    const bool flies = now.airspeed >= options_.take_off_speed * limits_.slowest;
    phase_ = flies ? FlightPhase::kClimbOut : FlightPhase::kRun;
    doing_ = Doing::kTakeOff;
  } else if (const auto* l = std::get_if<Land>(&command_.guidance)) {
    landing_.begin(*l, {p, geo::bearing(v)}, now.wind, loiter_radius(now.wind.norm()),
                   limits_, options_.landing);
    doing_ = Doing::kLand;
  } else {
    altitude_ = std::max(altitude_, options_.return_height - home_N_.z());
    hold_at(std::get<Return>(command_.guidance).point.value_or(home_N_.head<2>()), now);
  }
}

void FixedWingGuidance::arrive(const Vec2& at, const FixedWingMotion& now) {
  status_ = {};
  status_.done = true;
  hold_at(at, now);
}

FixedWingDemand FixedWingGuidance::step(const FixedWingMotion& now, double dt) {
  FixedWingDemand demand;
  demand.altitude_msl = altitude_;
  demand.airspeed = base_airspeed();
  double a = 0;
  switch (doing_) {
    case Doing::kCourse:
      a = hold_course(course_, now);
      break;
    case Doing::kBank:
      a = banked(now);
      break;
    case Doing::kCircle:
      a = circle(now, demand);
      break;
    case Doing::kPath:
      a = follow_path(now, demand);
      break;
    case Doing::kPlan:
      a = follow_plan(now, dt, demand);
      break;
    case Doing::kWaypoints:
      a = fly_waypoints(now, demand);
      break;
    case Doing::kTakeOff:
      a = take_off(now, demand);
      break;
    case Doing::kLand:
      a = land(now, dt, demand);
      break;
  }
  demand.lateral_acceleration = std::clamp(a, -max_lateral_, max_lateral_);
  status_.altitude_msl = demand.altitude_msl;
  status_.airspeed = demand.airspeed;
  return demand;
}

double FixedWingGuidance::hold_course(const Vec2& course,
                                      const FixedWingMotion& now) const {
  const GroundMotion ahead = ahead_of(over_ground(now), options_.lateral.roll_lag);
  return turn_towards(course, ahead.velocity, options_.lateral.course.gain);
}

// The acceleration across the ground track that a bank gives: a = g tan(roll) cos(drift).
double FixedWingGuidance::banked(const FixedWingMotion& now) const {
  const Vec2 v = now.v_N.head<2>(), air = v - now.wind;
  const double both = std::sqrt(v.squaredNorm() * air.squaredNorm());
  const double drift = both > 1e-6 ? std::max(v.dot(air) / both, 0.3) : 1;
  return kGravity * math::tan(std::clamp(bank_, -kMaxBank, kMaxBank)) * drift;
}

double FixedWingGuidance::circle(const FixedWingMotion& now, FixedWingDemand& demand) {
  const double wind = now.wind.norm();
  // The wind may have changed since: never tighter than what it allows now. A place is
  // held on a circle that shrinks again only when the wind has become much less.
  if (min_hold_ > 0) {
    const double tightest = turn_slowest_ * turn_slowest_ / max_lateral_;
    hold_.radius =
        std::max(min_hold_, model::ground_turn_radius(tightest, turn_slowest_, wind));
  } else {
    const double min = loiter_radius(wind);
    if (hold_.radius < min || hold_.radius > 1.25 * min) hold_.radius = min;
  }
  demand.airspeed = airspeed_for(1 / hold_.radius, wind);

  const Vec2 p = now.p_N.head<2>();
  const GroundMotion ahead = ahead_of(over_ground(now), options_.lateral.roll_lag);
  const CircleLine line =
      CircleLine::nearest_to(ahead.position, hold_.centre, hold_.radius, hold_.clockwise);
  const double distance = (p - hold_.centre).norm();
  const bool home = std::holds_alternative<Return>(command_.guidance);
  if (std::holds_alternative<Circle>(command_.guidance)) {
    status_.cross_track = -line.side * (distance - hold_.radius);
    status_.follows =
        status_.follows || std::abs(status_.cross_track) < kOnCircle * hold_.radius;
  } else if (home || std::holds_alternative<HoldPosition>(command_.guidance)) {
    status_.remaining = std::max(distance - hold_.radius, 0.0);
    status_.done = status_.done || distance <= 1.2 * hold_.radius;
  }
  const double from_centre = (ahead.position - line.centre).norm();
  const bool course = options_.lateral.law == LateralLaw::kCourse;
  const double speed = ahead.velocity.norm();
  const double reach = course ? kFarOff * options_.lateral.course.look_ahead * speed
                              : sight_.distance(speed) * sight_.sine;
  if (from_centre - line.radius >= reach)
    return turn_towards(line.turn_onto(from_centre), ahead.velocity,
                        course ? options_.lateral.course.gain
                               : sight_.gain * speed / sight_.distance(speed));
  return lateral(options_.lateral, sight_, line, line.nearest(),
                 line.cross_track(ahead.position), ahead);
}

double FixedWingGuidance::steer(const model::PathCursor& path,
                                const model::PathCursor::Place& place,
                                const FixedWingMotion& now) const {
  const GroundMotion motion = over_ground(now);
  const GroundMotion ahead = ahead_of(motion, options_.lateral.roll_lag);
  const double along = place.along + moved(place.point, place.cross_track,
                                           ahead.position - motion.position);
  const model::TrackPoint nearest = path.at(along);
  return lateral(options_.lateral, sight_, PathAhead{path, along}, nearest,
                 off_track(nearest, ahead.position), ahead);
}

}  // namespace skein::autopilot
