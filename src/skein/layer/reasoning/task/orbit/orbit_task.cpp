// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/orbit/orbit_task.h"

#include <algorithm>

#include "skein/model/path/flight_plan.h"
#include "skein/solve/target/orbit.h"
#include "skein/solve/target/standoff.h"

namespace skein::reasoning {
namespace {

constexpr double kChunk = 120;        // of an orbit, planned at a time [s]
constexpr double kOffTarget = 12;     // the target, from where it was planned to be [m]
constexpr double kAimAgain = 4;       // after the last aim, at the earliest [s]
constexpr double kTolerance = 5;      // of the distance on a circle [m]
constexpr double kBesideZones = 1.5;  // of the radius: room for the way to the circle
constexpr double kRoom = 1.02;        // of the smallest circle
constexpr double kReserve = 1.25;     // of turn radii, for a circle that is to be small
constexpr double kSlow = 1.15;        // of the minimum airspeed: room for gusts
constexpr double kClearly = 0.85;     // of a radius: so much nearer is worth S-turns

// What it circles with: no slower than gusts allow.
FlightLimits circling_limits(FlightLimits limits) {
  limits.slowest = std::min(kSlow * limits.slowest, limits.airspeed);
  return limits;
}

// Radius of a small circle: flown slowly, with room to correct [m].
double small_radius(const FlightLimits& limits) {
  const double slow =
      limits.slowest > 0 ? circling_limits(limits).slowest : limits.airspeed;
  return kReserve * solve::turn_radius_at(slow, limits);
}

// The orbit as asked for; where its circle is too tight for the wind and the target, the
// smallest one, or S-turns if these stay nearer to the target.
// @param round  a circle is asked for, of that radius.
solve::OrbitResult nearest_orbit(solve::OrbitQuery query, bool round) {
  solve::OrbitResult asked = solve::plan_orbit(query);
  if (asked.outcome != solve::OrbitOutcome::kRadiusTooSmall || asked.min_radius <= 0)
    return asked;
  query.radius = kRoom * asked.min_radius;
  solve::OrbitResult circle = solve::plan_orbit(query);
  if (round || query.limits.slowest <= 0) return circle;
  query.kind = solve::OrbitKind::kWeave;
  query.limits.airspeed = query.limits.slowest;
  solve::OrbitResult weave = solve::plan_orbit(query);
  return !weave.plan.empty() && weave.farthest < kClearly * query.radius ? weave : circle;
}

}  // namespace

OrbitTask::OrbitTask(const FlightContext& context, const Orbit& order)
    : PlannedTask(context, {}),
      order_(order),
      radius_(order.radius > 0 ? order.radius : small_radius(context.limits)) {}

Vec2 OrbitTask::target_at(const TaskStep& step, Time time) const {
  if (order_.object)
    if (const auto belief = step.beliefs.objects().find(*order_.object))
      return belief->at(time);
  return order_.point;
}

Vec2 OrbitTask::target_velocity(const TaskStep& step) const {
  if (order_.object)
    if (const auto belief = step.beliefs.objects().find(*order_.object))
      return belief->velocity_at(step.in.now);
  return Vec2::Zero();
}

const FlightIntent* OrbitTask::before(const TaskStep& step, AgentOutput& out) {
  const Time now = now_ = step.in.now;
  if (arrived_ && order_.duration > 0 && (now - *arrived_).seconds() >= order_.duration) {
    order_.point = target_at(step, now);
    set_done();
    return nullptr;
  }
  const Vec2 target = target_at(step, now);
  const double ground = context().map->elevation_msl(target);
  out.region_of_interest = {Vec3(target.x(), target.y(), -ground)};
  const ZoneMonitor& zones = step.safety.zones();
  if (!zones.zones().empty() &&
      zones.distance(target) < kBesideZones * radius_ + zones.margin()) {
    renew();
    beside_.what = Circling{target, {}};
    return &beside_;
  }
  if (!order_.object || (now - aimed_at_).seconds() < kAimAgain) return nullptr;
  const Vec2 planned = aim_ + (now - aimed_at_).seconds() * aim_velocity_;
  if ((target - planned).norm() > kOffTarget) renew();
  return nullptr;
}

PlannedTask::Part OrbitTask::plan_part(const Start& start, const TaskStep& step) {
  const Time begin = Time::from_seconds(start.time);
  solve::OrbitQuery query;
  query.kind = order_.weave ? solve::OrbitKind::kWeave : solve::OrbitKind::kCircle;
  query.target.at = {start.time, target_at(step, begin)};
  query.target.velocity = target_velocity(step);
  query.radius = radius_;
  query.tolerance = kTolerance;
  query.duration = kChunk;
  query.altitude_msl = -start.state.p_N.z();
  query.start_time = start.time;
  query.start = start.state;
  query.limits = circling_limits(start.limits);
  query.wind = start.wind;
  solve::OrbitResult result = nearest_orbit(query, order_.radius > 0);
  aimed_at_ = step.in.now;
  aim_ = target_at(step, step.in.now);
  aim_velocity_ = query.target.velocity;
  Part part;
  part.last = false;
  part.why_not = result.reason;
  part.plan = std::move(result.plan);
  if (!part.plan.empty()) part.milestones.push_back(result.entry_time);
  return part;
}

void OrbitTask::pass(const TaskStep& step) {
  if (!arrived_) arrived_ = step.in.now;
}

TaskProgress OrbitTask::progress(const AgentInput& in) const {
  TaskProgress progress = PlannedTask::progress(in);
  if (order_.duration <= 0 || progress.done || !arrived_) return progress;
  const double with = (now_ - *arrived_).seconds();
  progress.share = std::clamp(with / order_.duration, 0.0, 1.0);
  progress.time_to_go = std::max(0.0, order_.duration - with);
  return progress;
}

TaskKind OrbitTask::rest() const {
  Orbit rest = order_;
  if (arrived_ && rest.duration > 0)
    rest.duration = std::max(1.0, rest.duration - (now_ - *arrived_).seconds());
  return rest;
}

}  // namespace skein::reasoning
