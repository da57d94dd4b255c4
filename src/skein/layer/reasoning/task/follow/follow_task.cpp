// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/follow/follow_task.h"

#include <algorithm>
#include <utility>

namespace skein::reasoning {
namespace {

constexpr double kTurnRateLimit = 0.6;  // faster is noise of two positions [rad/s]
constexpr double kStaleLeader = 5;      // two positions this far apart say no turn [s]
constexpr double kLostLeader = 20;      // then the last plan is flown to its end [s]
constexpr std::size_t kAhead = 5;       // point of a plan whose bearing its course is

}  // namespace

void FollowTask::listen(const TaskStep& step) {
  for (const Message& message : step.in.inbox)
    if (const auto* reported = std::get_if<TeamPosition>(&message.content))
      hear(*reported);
}

void FollowTask::hear(const TeamPosition& reported) {
  if (reported.aircraft != order_.leader) return;
  if (leader_ && reported.nav.time <= leader_->at.time) return;  // overtaken
  LeaderMotion now{reported.nav, 0};
  if (leader_) {
    const double since = (reported.nav.time - leader_->at.time).seconds();
    const double turned = geo::wrap_pi(geo::bearing(geo::horizontal(reported.nav.v_N)) -
                                       geo::bearing(geo::horizontal(leader_->at.v_N)));
    if (since < kStaleLeader)
      now.turn_rate = std::clamp(turned / since, -kTurnRateLimit, kTurnRateLimit);
  }
  leader_ = now;
}

// Where it is when it begins to wait.
const FlightIntent* FollowTask::wait(const NavEstimate& nav) {
  if (std::exchange(waits_, true)) return &intent_;
  Steering steering;
  steering.guidance = HoldPosition{geo::horizontal(nav.p_N)};
  steering.altitude_msl = -nav.p_N.z();
  intent_.what = std::move(steering);
  return &intent_;
}

const FlightIntent* FollowTask::plan(const TaskStep& step, AgentOutput&) {
  const AgentInput& in = step.in;
  if (!leader_) return wait(*in.nav);
  const bool lost = (in.now - leader_->at.time).seconds() > kLostLeader;
  if (lost && demanded_) return &intent_;
  if (lost) return wait(*in.nav);
  waits_ = false;
  // What nobody has flown since, or what has come to its end, says nothing of now.
  if (!obeys_orders(in.autopilot) ||
      (demanded_ && demanded_->end() < in.nav->time.seconds()))
    demanded_.reset();
  NavEstimate from = *in.nav;
  if (demanded_) {
    const model::PlanCurve::State height = demanded_->at(from.time.seconds());
    from.p_N.z() = height.p_N.z();
    from.v_N.z() = height.v_N.z();
  }
  FollowPlan plan{plan_to_slot(from, *leader_, order_.offset, limits_, horizon_)};
  demanded_.emplace().assign(plan.plan);
  const Vec2 ahead = geo::horizontal(
      plan.plan[std::min<std::size_t>(kAhead, plan.plan.size() - 1)].p_N - in.nav->p_N);
  Steering steering;
  steering.course = geo::bearing(ahead);
  steering.guidance = std::move(plan);
  steering.altitude_msl = -from.p_N.z();
  intent_.what = std::move(steering);
  return &intent_;
}

}  // namespace skein::reasoning
