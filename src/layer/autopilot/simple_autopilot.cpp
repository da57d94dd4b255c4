#include "layer/autopilot/simple_autopilot.h"

#include <algorithm>
#include <cmath>

#include "data/air.h"
#include "model/path/path_geometry.h"
#include "model/path/wind_triangle.h"

namespace skein::autopilot {
namespace {

constexpr double kSlowDown = 6;  // flight before a tight turn in which to slow down [s]

bool same(const Path& a, const Path& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const PathElement& x, const PathElement& y) {
                      return x.start == y.start && x.course == y.course &&
                             x.length == y.length && x.curvature == y.curvature;
                    });
}

}  // namespace

SimpleAutopilot::SimpleAutopilot(const SimpleAutopilotOptions& options,
                                 const FlightLimits& limits, const NavEstimate& initial)
    : options_(options),
      limits_(limits),
      roll_limit_(
          std::atan(limits.airspeed * limits.airspeed / (kGravity * limits.turn_radius))),
      filter_(initial, options.wind_lag) {
  home_ = geo::horizontal(initial.p_N);
  command_.guidance = circle_around(home_);
  command_.altitude_msl = -initial.p_N.z();
}

void SimpleAutopilot::sense(const SensorSample& sample) {
  if (const auto* fix = std::get_if<GnssFix>(&sample)) filter_.add(*fix);
  if (const auto* air = std::get_if<AirDataSample>(&sample)) filter_.add(*air);
}

void SimpleAutopilot::command(const AutopilotCommand& command) {
  const auto* now = std::get_if<FollowPath>(&command_.guidance);
  const auto* next = std::get_if<FollowPath>(&command.guidance);
  const bool goes_on = now && next && same(now->path, next->path);
  command_ = command;
  if (goes_on) return;
  status_ = {};
  along_ = 0;
  hold_circle_ = circle_around(home_);
  if (const auto* hold = std::get_if<HoldPosition>(&command_.guidance))
    hold_circle_ = circle_around(hold->point);
  if (!next) return;
  status_.remaining = model::length(next->path);
  status_.done = next->path.empty();
  if (status_.done) end_circle_ = circle_around(geo::horizontal(estimate().p_N));
}

Control SimpleAutopilot::control(Time now, double /*dt*/) {
  filter_.advance(now);
  const NavEstimate& nav = filter_.estimate();
  const Motion motion{geo::horizontal(nav.p_N), nav.heading, filter_.airspeed(),
                      filter_.drift()};
  const double turn_rate = turn_rate_for(demand(motion), motion, options_.guidance);

  FlightCommand out;
  out.roll = std::clamp(std::atan(turn_rate * motion.airspeed / kGravity), -roll_limit_,
                        roll_limit_);
  out.airspeed = airspeed_for_turns();
  out.climb_rate =
      std::clamp(options_.altitude_gain * (command_.altitude_msl + nav.p_N.z()),
                 -limits_.climb_rate, limits_.climb_rate);
  return out;
}

CourseDemand SimpleAutopilot::demand(const Motion& motion) {
  const double ground_speed =
      std::max(geo::horizontal(filter_.estimate().v_N).norm(), 0.2 * limits_.airspeed);
  if (const auto* hold = std::get_if<HoldCourse>(&command_.guidance))
    return {hold->course, 0};
  if (const auto* around = std::get_if<Circle>(&command_.guidance))
    return circle(*around, motion.position, ground_speed, options_.guidance);
  if (const auto* follows = std::get_if<FollowPath>(&command_.guidance))
    return follow(follows->path, motion, ground_speed);
  return circle(hold_circle_, motion.position, ground_speed, options_.guidance);
}

CourseDemand SimpleAutopilot::follow(const Path& path, const Motion& motion,
                                     double ground_speed) {
  if (status_.done)
    return circle(end_circle_, motion.position, ground_speed, options_.guidance);
  // Only the near part of the path counts, so that it may cross itself.
  const double window = 5 * options_.guidance.look_ahead * ground_speed;
  const model::PathProjection at =
      model::project(path, motion.position, along_ - window / 5, along_ + window);
  along_ = at.along;
  status_.remaining = at.remaining;
  status_.cross_track = at.cross_track;

  const model::Pose end = model::end_of(path.back());
  const Vec2 beyond = motion.position - end.position;
  if (at.remaining <= 0 && beyond.dot(geo::unit(end.course)) >= 0) {
    status_ = {0, 0, true};
    end_circle_ = circle_around(end.position);
    return circle(end_circle_, motion.position, ground_speed, options_.guidance);
  }
  const double ahead = along_ + ground_speed * options_.guidance.anticipation;
  return track(at.course, model::curvature_at(path, ahead), at.cross_track, ground_speed,
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
  double tightest = 0;
  if (const auto* follow = std::get_if<FollowPath>(&command_.guidance)) {
    if (status_.done) return limits_.airspeed;  // the end's circle is wide enough
    const double reach = along_ + kSlowDown * geo::horizontal(estimate().v_N).norm();
    double start = 0;
    for (const PathElement& e : follow->path) {
      if (start > reach) break;
      if (start + e.length > along_) tightest = std::max(tightest, std::abs(e.curvature));
      start += e.length;
    }
  } else if (const auto* around = std::get_if<Circle>(&command_.guidance)) {
    tightest = 1 / around->radius;
  }
  if (tightest == 0) return limits_.airspeed;
  const double ground_speed = std::sqrt(kGravity * std::tan(roll_limit_) / tightest);
  return std::clamp(ground_speed - filter_.drift().norm(),
                    options_.slowest * limits_.airspeed, limits_.airspeed);
}

}  // namespace skein::autopilot
