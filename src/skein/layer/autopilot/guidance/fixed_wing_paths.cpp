// SPDX-License-Identifier: Apache-2.0
// FixedWingGuidance on paths, plans and routes.

#include <algorithm>
#include <cmath>

#include "skein/layer/autopilot/guidance/fixed_wing_guidance.h"
#include "skein/layer/autopilot/guidance/steering.h"

namespace skein::autopilot {
namespace {

struct PlanAhead {
  const model::PlanCurve& plan;
  double time, speed;
  model::TrackPoint at(double ahead) const {
    return model::PlanCurve::track(plan.at(time + ahead / speed));
  }
};

}  // namespace

double FixedWingGuidance::follow_path(const FixedWingMotion& now,
                                      FixedWingDemand& demand) {
  const Vec2 p = now.p_N.head<2>();
  const double speed = std::max(now.v_N.head<2>().norm(), kMinSpeed);
  // Only the near part of the path counts, so that it may cross itself.
  const model::PathCursor::Place place =
      path_.project(p, along_ - 3 * speed, along_ + 15 * speed);
  along_ = place.along;
  if (place.remaining <= 0 && (p - place.point.position).dot(place.point.tangent) >= 0) {
    arrive(place.point.position, now);
    return circle(now, demand);
  }
  status_.remaining = place.remaining;
  status_.cross_track = place.cross_track;
  status_.along = place.point.tangent;
  status_.follows = true;
  demand.airspeed = airspeed_for(
      path_.tightest(along_, along_ + options_.slow_down * speed), now.wind.norm());
  return steer(path_, place, now);
}

double FixedWingGuidance::follow_plan(const FixedWingMotion& now, double dt,
                                      FixedWingDemand& demand) {
  const Vec2 p = now.p_N.head<2>();
  const double followed = plan_.follow(p, plan_time_);
  const model::PlanCurve::State here = plan_.at(followed);
  const double speed = here.v_N.head<2>().norm();
  // Where the plan stands still only time passes.
  plan_time_ = followed == plan_time_ && speed < kMinSpeed ? followed + dt : followed;
  const model::TrackPoint track = model::PlanCurve::track(here);
  if (plan_time_ >= plan_.end()) {
    altitude_ = -plan_.at(plan_.end()).p_N.z();
    demand.altitude_msl = altitude_;
    arrive(plan_.at(plan_.end()).p_N.head<2>(), now);
    return circle(now, demand);
  }
  const double late = now.time.seconds() - plan_time_;
  status_.time_error = late;
  status_.remaining = plan_.remaining(plan_time_);
  status_.cross_track = off_track(track, p);
  status_.along = track.tangent;
  status_.follows = true;

  const double share =
      std::clamp(options_.time_gain * late, -options_.time_reach, options_.time_reach);
  const Vec3 soon = plan_.at(std::min(plan_time_ + options_.speed_lead, plan_.end())).v_N;
  const Vec2 air = (1 + share) * soon.head<2>() - now.wind;
  demand.airspeed = std::clamp(std::sqrt(air.squaredNorm() + soon.z() * soon.z()),
                               limits_.slowest, limits_.fastest);
  if (command_.airspeed) demand.airspeed = base_airspeed();
  demand.altitude_msl = -here.p_N.z();
  const double flown = now.v_N.head<2>().dot(track.tangent);
  const double pace = std::clamp(flown / std::max(speed, kMinSpeed), 0.0, 2.0);
  demand.climb_rate = -here.v_N.z() * pace;

  const GroundMotion motion = over_ground(now);
  const GroundMotion ahead = ahead_of(motion, options_.lateral.roll_lag);
  const double per_second = std::max(speed, kMinSpeed);
  const double then =
      plan_time_ +
      moved(track, status_.cross_track, ahead.position - motion.position) / per_second;
  const model::TrackPoint nearest = model::PlanCurve::track(plan_.at(then));
  return lateral(options_.lateral, sight_, PlanAhead{plan_, then, per_second}, nearest,
                 off_track(nearest, ahead.position), ahead);
}

double FixedWingGuidance::fly_waypoints(const FixedWingMotion& now,
                                        FixedWingDemand& demand) {
  const Vec2 p = now.p_N.head<2>();
  const double speed = std::max(now.v_N.head<2>().norm(), kMinSpeed);
  const double wind = now.wind.norm();
  if (options_.rounds_corners) route_.set_rule({loiter_radius(wind), 0});
  const WaypointRoute::Place place = route_.project(p, 3 * speed);
  if (place.done) {
    altitude_ = place.altitude_msl;
    demand.altitude_msl = altitude_;
    arrive(route_.last().point, now);
    status_.lap = route_.laps();
    return circle(now, demand);
  }
  status_.remaining = place.remaining;
  status_.cross_track = place.on_path.cross_track;
  status_.along = place.on_path.point.tangent;
  status_.follows = true;
  status_.lap = route_.lap();
  demand.altitude_msl = place.altitude_msl;
  demand.climb_rate = place.slope * now.v_N.head<2>().dot(place.on_path.point.tangent);
  const double along = place.on_path.along;
  demand.airspeed = airspeed_for(
      route_.cursor().tightest(along, along + options_.slow_down * speed), wind);
  return steer(route_.cursor(), place.on_path, now);
}

}  // namespace skein::autopilot
