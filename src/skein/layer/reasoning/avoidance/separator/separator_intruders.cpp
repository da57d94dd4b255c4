// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "skein/geo/rotation.h"
#include "skein/layer/reasoning/avoidance/separator/separator.h"
#include "skein/model/path/flight_plan.h"

// How the separator keeps out of the way of those who say nothing of their plans.

namespace skein::reasoning {
namespace {

constexpr double kAvoidPeriod = 1;  // [s]
constexpr double kTeamAhead = 25;   // of a turn, in which members are looked for [s]
constexpr double kTeamStep = 0.5;   // [s]
constexpr double kLeaves = 1.5;     // of what is kept up and down
constexpr double kSameLevel = 1;    // [m]

}  // namespace

void Separator::avoid_intruders(const SeparationStep& step) {
  if (options_.method != SeparationMethod::kAuto || step.keeps_on) return;
  if ((step.now - avoided_).seconds() < kAvoidPeriod && avoided_ != Time()) return;
  avoided_ = step.now;
  if (step.intruders.empty() && !turn_) return;
  const double until = rejoins(step.now.seconds());
  const std::vector<PlannedFlight> others = rooms(step, false);
  const auto action = intruders_.step({step.now.seconds(), step.p_N, step.v_N, own_.plan,
                                       until, step.intruders, step.query, step.zones,
                                       others, options_.intruder_room});
  if (action == IntruderAvoidance::Action::kPlan) {
    turn_.reset();
    adopt(intruders_.flight(),
          {intruders_.begin(),
           until,
           intruders_.encounter().end,
           SeparationMethod::kNonCooperative,
           {},
           0,
           "around an intruder"},
          step.now);
  } else if (action == IntruderAvoidance::Action::kTrack) {
    const double course = intruders_.track();
    const double climb = climb_from_team(step, course).value_or(intruders_.climb());
    turn_ = Heading{course, safe_altitude(step, course, -step.p_N.z() + climb)};
    reason_ = "turns away from an intruder";
  } else if (turn_) {
    begun_ = false;  // what it wants is planned from here
    turn_.reset();
  }
}

// Up or down from the first of the team whom it would meet on a course; bands know of
// intruders only. The higher climbs; at one height the lower id does.
std::optional<double> Separator::climb_from_team(const SeparationStep& step,
                                                 double course) const {
  const double now = step.now.seconds();
  const Vec2 v_N = step.v_N.head<2>().norm() * geo::unit(course);
  std::optional<double> climb;
  double first = kTeamAhead;
  for (const TeamFlight& each : team_.flights()) {
    const TeamFlight::Expected expected = each.expected(step.now);
    if (!expected.plan) continue;
    const Separation kept = separation_of(own_, each, expected.unknown);
    for (double t = 0; t < first; t += kTeamStep) {
      const Vec3 theirs = model::moment_at(*expected.plan, now + t).p_N;
      const Vec2 own = step.p_N.head<2>() + t * v_N;
      const double below = theirs.z() - step.p_N.z();
      if ((theirs.head<2>() - own).norm() >= kept.horizontal ||
          std::abs(below) >= kept.vertical)
        continue;
      const bool up = std::abs(below) > kSameLevel ? below > 0 : self_ < each.who;
      climb = (up ? 1 : -1) * kLeaves * kept.vertical;
      first = t;
    }
  }
  return climb;
}

}  // namespace skein::reasoning
