// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "skein/data/vehicle/agent_step.h"
#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/model/path/path_geometry.h"
#include "skein/model/path/plan_curve.h"
#include "skein/model/path/wind_triangle.h"
#include "skein/role/terrain.h"

namespace skein::reasoning::test {

class FlatGround final : public Terrain {
 public:
  double elevation_msl(const Vec2&) const override { return 100; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};

/// Aircraft and autopilot of these tests (layers do not know each other): 20 m/s, 60 m
/// turn radius, roll at 1 rad/s, perfect knowledge of itself and of a steady wind.
class TestAircraft {
 public:
  Vec3 p = {0, 0, -220};
  double heading = 0;
  Vec2 wind = Vec2::Zero();
  AutopilotCommand command;
  AutopilotStatus status;

  Vec2 position() const { return geo::horizontal(p); }
  Vec2 velocity() const { return kAirspeed * geo::unit(heading) + wind; }

  NavEstimate nav(Time now) const {
    NavEstimate n;
    n.time = now;
    n.p_N = p;
    n.v_N = {velocity().x(), velocity().y(), 0};
    n.heading = geo::wrap_pi(heading);
    n.wind_N = wind;
    n.roll = roll_;
    return n;
  }

  void obey(const AutopilotCommand& next) {
    const auto* now = std::get_if<FollowPath>(&command.guidance);
    const auto* then = std::get_if<FollowPath>(&next.guidance);
    const bool same = now && then && now->path.front().start == then->path.front().start;
    const auto* plan = std::get_if<FollowPlan>(&next.guidance);
    const auto* flown = std::get_if<FollowPlan>(&command.guidance);
    const bool same_plan = plan && flown && plan->plan.size() == flown->plan.size() &&
                           plan->plan.back().time == flown->plan.back().time;
    if (!same && !same_plan) along_ = 0, status = {};
    if (plan && !same_plan) {
      curve_.assign(plan->plan);
      on_curve_ = curve_.start();
    }
    command = next;
  }

  void step(double dt) {
    const double fastest = kAirspeed / kRadius;
    const double course = course_setpoint();
    const double aim =
        model::heading_for_course(course, kAirspeed, wind).value_or(course);
    const double limit = std::atan(fastest * kAirspeed / 9.80665);
    const double roll =
        std::clamp(std::atan(1.2 * geo::wrap_pi(aim - heading) * kAirspeed / 9.80665),
                   -limit, limit);
    roll_ += std::clamp(roll - roll_, -dt, dt);
    const double turn = 9.80665 * std::tan(roll_) / kAirspeed * dt;
    heading += turn / 2;
    p.head<2>() += dt * velocity();
    heading += turn / 2;
    const bool planned = std::holds_alternative<FollowPlan>(command.guidance);
    const double down = planned ? curve_.at(on_curve_).p_N.z() : -command.altitude_msl;
    p.z() += std::clamp(down - p.z(), -3 * dt, 3 * dt);
  }

 private:
  static constexpr double kAirspeed = 20, kRadius = 60;

  double course_setpoint() {
    if (const auto* hold = std::get_if<HoldCourse>(&command.guidance))
      return hold->course;
    if (const auto* circle = std::get_if<Circle>(&command.guidance)) {
      const Vec2 out = position() - circle->centre;
      const double side = circle->clockwise ? 1 : -1;
      const double ahead =
          velocity().norm() / circle->radius;  // course change in a second
      return geo::bearing(out) +
             side * (geo::kPi / 2 + 0.8 * ahead +
                     std::atan2(out.norm() - circle->radius, 3 * velocity().norm()));
    }
    if (const auto* hold = std::get_if<HoldPosition>(&command.guidance)) {
      const Vec2 out = position() - hold->point;
      return geo::bearing(out) + geo::kPi / 2 +
             std::atan2(out.norm() - 1.3 * kRadius, 3 * velocity().norm());
    }
    if (std::holds_alternative<FollowPlan>(command.guidance)) return course_on_plan();
    const Path& path = std::get<FollowPath>(command.guidance).path;
    const auto at = model::project(path, position(), along_ - 50, along_ + 100);
    along_ = at.along;
    status.remaining = at.remaining;
    status.cross_track = at.cross_track;
    status.done = status.done || at.remaining <= 0;
    const Vec2 ahead = model::pose_at(path, along_ + 40).position - position();
    return geo::bearing(ahead);
  }

  // Along the plan's line at its own airspeed, then around its end.
  double course_on_plan() {
    on_curve_ = std::min(curve_.follow(position(), on_curve_), curve_.end());
    const auto here = curve_.at(on_curve_);
    const Vec2 left = geo::horizontal(curve_.at(curve_.end()).p_N) - position();
    status.follows = !status.done;
    status.cross_track = (geo::horizontal(here.p_N) - position()).norm();
    if (on_curve_ >= curve_.end() - 0.05 && left.dot(geo::horizontal(here.v_N)) <= 0)
      status.done = true;
    if (status.done)
      return geo::bearing(-left) + geo::kPi / 2 +
             std::atan2(left.norm() - 1.3 * kRadius, 3 * velocity().norm());
    const Vec2 ahead =
        geo::horizontal(curve_.at(std::min(on_curve_ + 2, curve_.end() + 2)).p_N) -
        position();
    return geo::bearing(ahead);
  }

  double roll_ = 0;
  double along_ = 0;
  model::PlanCurve curve_;
  double on_curve_ = 0;
};

}  // namespace skein::reasoning::test
