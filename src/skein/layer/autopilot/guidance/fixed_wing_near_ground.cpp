// SPDX-License-Identifier: Apache-2.0
// FixedWingGuidance in the take-off and the landing.

#include <algorithm>

#include "skein/layer/autopilot/guidance/fixed_wing_guidance.h"
#include "skein/layer/autopilot/guidance/steering.h"

namespace skein::autopilot {
namespace {

constexpr double kLifted = 0.5;      // climb rate of what no longer rolls [m/s]
constexpr double kClimbSpeed = 1.3;  // after take-off, over the slowest airspeed
constexpr double kClimbTurn = 4.5;   // lateral acceleration of the circling climb [m/s^2]
constexpr double kStopped = 0.5;     // of the slowest airspeed: no longer flying
constexpr double kStands = 1;        // height at most, measured, at rest [m]

}  // namespace

// The climb is steepest and fastest well below cruise, and a runway ends.
double FixedWingGuidance::climb_airspeed() const {
  return std::clamp(kClimbSpeed * limits_.slowest, limits_.slowest, base_airspeed());
}

double FixedWingGuidance::take_off(const FixedWingMotion& now, FixedWingDemand& demand) {
  const double height = now.height_agl.value_or(-now.p_N.z() - run_altitude_);
  // What a gust has lifted flies on: held down it would fall.
  if (phase_ == FlightPhase::kRun &&
      (now.airspeed >= options_.take_off_speed * limits_.slowest ||
       -now.v_N.z() > kLifted))
    phase_ = FlightPhase::kClimbOut;
  if (phase_ == FlightPhase::kClimbOut &&
      (height >= options_.climb_out_height ||
       -now.p_N.z() >= altitude_ - options_.arrival)) {
    phase_ = FlightPhase::kFlight;
    hold_at(home_N_.head<2>(), now);
    doing_ = Doing::kTakeOff;
  }
  demand.phase = phase_;
  status_.remaining = std::max(altitude_ + now.p_N.z(), 0.0);
  if (phase_ == FlightPhase::kFlight) {
    status_.done = status_.done || -now.p_N.z() >= altitude_ - options_.arrival;
    const double a = circle(now, demand);
    if (status_.done) return a;
    // A steep turn would take the lift that is left at this airspeed, and the climb.
    demand.airspeed = std::min(demand.airspeed, climb_airspeed());
    return std::clamp(a, -kClimbTurn, kClimbTurn);
  }
  demand.airspeed = climb_airspeed();
  // Along the line of the run.
  const GroundMotion ahead = ahead_of(over_ground(now), options_.lateral.roll_lag);
  const Vec2 off = ahead.position - run_start_;
  const model::TrackPoint line{run_start_ + off.dot(course_) * course_, course_, 0};
  const double a = course_law(line, off_track(line, ahead.position), ahead.velocity,
                              options_.lateral.course);
  if (phase_ == FlightPhase::kRun) return std::clamp(a, -kFlares, kFlares);
  return a;
}

double FixedWingGuidance::land(const FixedWingMotion& now, double dt,
                               FixedWingDemand& demand) {
  const Vec2 p = now.p_N.head<2>();
  const double speed = now.v_N.head<2>().norm();
  // On the ground the wind alone may be airspeed.
  const bool still =
      phase_ == FlightPhase::kRollOut
          ? speed < kMinSpeed
          : std::min(now.airspeed, speed + now.wind.norm()) <
                    kStopped * limits_.slowest ||
                (now.height_agl && *now.height_agl < kStands && speed < kMinSpeed);
  const Landing::Step at =
      landing_.step({p, -now.p_N.z(), now.height_agl, -now.v_N.z(), speed, still}, dt);
  demand.phase = phase_ = at.phase;
  demand.braking = at.braking;
  demand.altitude_msl = at.altitude_msl;
  demand.climb_rate = at.climb_rate;
  status_.remaining = at.place.remaining;
  status_.cross_track = at.place.cross_track;
  status_.follows = at.phase != FlightPhase::kGround;
  status_.done = at.done;
  if (at.done && !options_.landing.touches_down) {
    altitude_ = landing_.command().ground_msl + options_.landing.floor;
    demand = {0, altitude_, 0, base_airspeed(), FlightPhase::kFlight};
    arrive(landing_.command().point, now);
    return circle(now, demand);
  }
  if (at.phase == FlightPhase::kGround) return 0;
  const double a = steer(landing_.path(), at.place, now);
  if (at.phase == FlightPhase::kFlight) return a;
  demand.airspeed = std::min(at.airspeed, limits_.fastest);
  if (at.aligns) demand.heading = geo::unit(landing_.course());
  return at.phase == FlightPhase::kApproach ? a : std::clamp(a, -kFlares, kFlares);
}

}  // namespace skein::autopilot
